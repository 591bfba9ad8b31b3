// Faces become polygons in four steps: weld positions (for comparing alone), clean each face and triangulate
// it, drop triangles that an earlier face has already, keep what is left.
//
// Planarity: a face is planar where no corner is further than 1e-5 of the face's size from its plane. Files
// carry six digits or so, which moves a corner of a face in the middle of its scene by 1e-6 of the scene's
// size; an error of 1e-5 in a face's own proportions tilts it by 6e-4 degrees and changes no form factor
// visibly. The measure is relative to the face alone, so that it knows neither unit nor place of the scene. A
// face beyond it is split into its triangles: their common shape is not defined by the format, and of a
// quadrilateral the diagonal is taken that gives the better triangles.
#include "scene/obj_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

#include "base/cancel.h"
#include "base/error.h"
#include "scene/polygon_plane.h"
#include "scene/triangulate.h"

namespace unshot {
namespace {

constexpr double kPlanarity = 1e-5;
constexpr double kAreaAgreement = 1e-7;

/// For each position the first one with the same coordinates.
// Shares of the time until faces are clean, and until none is there twice.
constexpr double kCleaned = 0.4, kUnique = 0.8;

std::vector<std::uint32_t> weld(const std::vector<glm::dvec3>& positions, const CancelToken& cancel) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto finite = [&](std::uint32_t i) {
    return std::isfinite(positions[i].x) && std::isfinite(positions[i].y) && std::isfinite(positions[i].z);
  };
  const auto key = [&](std::uint32_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
  std::vector<std::uint32_t> same(order);
  order.erase(std::remove_if(order.begin(), order.end(), [&](std::uint32_t i) { return !finite(i); }),
              order.end());
  std::sort(order.begin(), order.end(), cancel.checking([&](std::uint32_t a, std::uint32_t b) {
    return key(a) != key(b) ? key(a) < key(b) : a < b;
  }));
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (key(order[k]) == key(order[k - 1])) same[order[k]] = same[order[k - 1]];
  }
  return same;
}

struct FaceTriangle {
  std::array<std::uint32_t, 3> corners;  ///< in ObjNumbers' corner arrays, in the file's winding
  bool duplicate = false;
};

/// A face after cleaning.
struct CleanFace {
  std::uint32_t face = 0;  ///< in ObjScan::faces
  std::uint32_t material = 0;
  std::uint32_t first_corner = 0, corner_count = 0;      ///< in Builder::kept_corners_
  std::uint32_t first_triangle = 0, triangle_count = 0;  ///< in Builder::triangles_
  bool whole = true;  ///< planar and simple: one polygon, unless some of its triangles are duplicates
};

class Builder {
 public:
  Builder(const ObjScan& scan, const ObjNumbers& numbers, const ObjMaterials& materials, Scene& scene,
          const CancelToken& cancel)
      : scan_(scan),
        numbers_(numbers),
        materials_(materials),
        scene_(scene),
        cancel_(cancel),
        welded_(weld(numbers.positions, cancel)) {}

  void run() {
    std::uint32_t first = 0;
    for (std::uint32_t f = 0; f < scan_.faces.size(); ++f) {
      cancel_.check();
      if (f % kToldEvery == 0) cancel_.report(kCleaned * f / static_cast<double>(scan_.faces.size()));
      checkCorners(scan_.faces[f], first);
      cleanFace(f, first);
      first += scan_.faces[f].corner_count;
    }
    cancel_.report(kCleaned);
    markDuplicates();
    cancel_.report(kUnique);
    emitPolygons();
    if (scene_.polygons.empty()) {
      throw Error(ErrorKind::kInput, "no face of the scene has an area",
                  placeOf(scene_.path, scan_.faces[0].line),
                  "check the vertices; are they all at one place?");
    }
    keepUsedPoints();
    scene_.face_count = scan_.faces.size();
    report();
  }

 private:
  void checkCorners(const ObjFace& face, std::uint32_t first) const {
    const auto fail = [&](const std::string& message, const std::string& advice) {
      throw Error(ErrorKind::kInput, message, placeOf(scene_.path, face.line), advice);
    };
    for (std::uint32_t c = first; c < first + face.corner_count; ++c) {
      const std::uint32_t v = numbers_.corner_positions[c];
      if (v >= numbers_.positions.size()) {
        fail("vertex index " + std::to_string(std::uint64_t{v} + 1) + " is out of range; there are " +
                 counted(numbers_.positions.size(), "vertex", "vertices"),
             "export the scene again; is the end of the file missing?");
      }
      const glm::dvec3& p = numbers_.positions[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        fail("vertex " + std::to_string(std::uint64_t{v} + 1) + " of this face is not finite",
             "correct the vertex or remove the face");
      }
      const std::uint32_t n = numbers_.corner_normals[c];
      if (n != kNone && n >= numbers_.normals.size()) {
        fail("normal index " + std::to_string(std::uint64_t{n} + 1) + " is out of range; there are " +
                 counted(numbers_.normals.size(), "normal", "normals"),
             "export the scene again");
      }
    }
  }

  std::uint32_t weldedAt(std::uint32_t corner) const { return welded_[numbers_.corner_positions[corner]]; }

  /// The face's corners without those that repeat the one before.
  void distinctCorners(const ObjFace& face, std::uint32_t first) {
    loop_.clear();
    for (std::uint32_t c = first; c < first + face.corner_count; ++c) {
      if (loop_.empty() || weldedAt(loop_.back()) != weldedAt(c)) loop_.push_back(c);
    }
    while (loop_.size() > 1 && weldedAt(loop_.front()) == weldedAt(loop_.back())) loop_.pop_back();
  }

  void cleanFace(std::uint32_t f, std::uint32_t first) {
    const ObjFace& face = scan_.faces[f];
    distinctCorners(face, first);
    if (loop_.size() >= 3 && loop_.size() < face.corner_count) repeated_.add(face.line);

    CleanFace clean;
    clean.face = f;
    clean.material =
        face.material_name == kNone ? materials_.without_name : materials_.of_name[face.material_name];
    clean.first_corner = static_cast<std::uint32_t>(kept_corners_.size());
    clean.corner_count = static_cast<std::uint32_t>(loop_.size());
    clean.first_triangle = static_cast<std::uint32_t>(triangles_.size());
    kept_corners_.insert(kept_corners_.end(), loop_.begin(), loop_.end());
    clean.whole = splitFace(face.line);
    clean.triangle_count = static_cast<std::uint32_t>(triangles_.size()) - clean.first_triangle;
    if (clean.triangle_count > 0) {
      faces_.push_back(clean);
    } else {
      kept_corners_.resize(clean.first_corner);
      degenerate_.add(face.line);
    }
  }

  PolygonPlane planeOfLoop() {
    points_.clear();
    for (const std::uint32_t c : loop_) points_.push_back(numbers_.positions[numbers_.corner_positions[c]]);
    return planeOf(points_);
  }

  /// Turns loop_ so that it begins at its first welded position and goes on to the earlier neighbour: so the
  /// triangles of a planar face do not depend on where the file begins it or which way round it goes, and its
  /// copies are found. (The shape of a face that is not planar depends on its triangles: there the file's
  /// order is kept.) Returns whether it was turned over.
  bool makeCanonical() {
    const auto smallest = std::min_element(loop_.begin(), loop_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return weldedAt(a) < weldedAt(b);
    });
    std::rotate(loop_.begin(), smallest, loop_.end());
    const bool turned = weldedAt(loop_.back()) < weldedAt(loop_[1]);
    if (turned) std::reverse(loop_.begin() + 1, loop_.end());
    return turned;
  }

  /// Adds the triangles of loop_; returns whether they make one planar, simple polygon.
  bool splitFace(std::uint32_t line) {
    if (loop_.size() < 3) return false;
    PolygonPlane plane = planeOfLoop();
    if (plane.flat) return false;
    if (loop_.size() == 3) {
      addTriangle({0, 1, 2}, false);
      return true;
    }
    const bool planar = plane.thickness <= kPlanarity * plane.size;
    bool turned = false;
    if (planar) {
      turned = makeCanonical();
      plane = planeOfLoop();
    }
    projectOnto(plane, points_, outline_);
    const auto triangles = triangulate(outline_);
    double area = 0;
    for (const std::array<std::uint32_t, 3>& t : triangles) {
      const glm::dvec2 u = outline_[t[1]] - outline_[t[0]], v = outline_[t[2]] - outline_[t[0]];
      area += 0.5 * (u.x * v.y - u.y * v.x);
      addTriangle(t, turned);
    }
    const bool simple =
        triangles.size() == loop_.size() - 2 && std::abs(area - plane.area) <= kAreaAgreement * plane.area;
    if (!triangles.empty() && !simple) not_simple_.add(line);
    if (!planar) not_planar_.add(line);
    return simple && planar;
  }

  void addTriangle(const std::array<std::uint32_t, 3>& t, bool turned) {
    FaceTriangle triangle{{loop_[t[0]], loop_[t[1]], loop_[t[2]]}};
    if (turned) std::swap(triangle.corners[1], triangle.corners[2]);
    triangles_.push_back(triangle);
  }

  void markDuplicates() {
    struct Key {
      std::array<std::uint32_t, 3> positions;
      std::uint32_t triangle;
      bool operator<(const Key& other) const {
        return std::tie(positions, triangle) < std::tie(other.positions, other.triangle);
      }
    };
    std::vector<std::uint32_t> face_of(triangles_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::uint32_t k = 0; k < faces_[f].triangle_count; ++k) face_of[faces_[f].first_triangle + k] = f;
    }
    std::vector<Key> keys(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const auto& corners = triangles_[t].corners;
      keys[t] = {{weldedAt(corners[0]), weldedAt(corners[1]), weldedAt(corners[2])}, t};
      std::sort(keys[t].positions.begin(), keys[t].positions.end());
    }
    std::sort(keys.begin(), keys.end(), cancel_.checking(std::less<>()));
    std::size_t first = 0;
    for (std::size_t k = 1; k < keys.size(); ++k) {
      if (keys[k].positions != keys[first].positions) {
        first = k;
        continue;
      }
      triangles_[keys[k].triangle].duplicate = true;
      const CleanFace& kept = faces_[face_of[keys[first].triangle]];
      const CleanFace& dropped = faces_[face_of[keys[k].triangle]];
      Tally& tally = kept.material == dropped.material ? duplicate_ : conflicting_;
      const std::uint32_t line = scan_.faces[dropped.face].line;
      const std::uint32_t earliest = tally.count == 0 ? line : std::min(tally.first_line, line);
      tally.add(line);
      tally.first_line = earliest;
    }
  }

  void emitPolygons() {
    for (const CleanFace& clean : faces_) {
      cancel_.check();
      const auto begin = triangles_.begin() + clean.first_triangle;
      const auto end = begin + clean.triangle_count;
      const auto duplicates = std::count_if(begin, end, [](const FaceTriangle& t) { return t.duplicate; });
      scene_.triangle_count += clean.triangle_count - static_cast<std::size_t>(duplicates);
      if (clean.whole && duplicates == 0) {
        emit(clean, {kept_corners_.data() + clean.first_corner, clean.corner_count});
        continue;
      }
      for (auto t = begin; t != end; ++t) {
        if (!t->duplicate) emit(clean, t->corners);
      }
    }
  }

  void emit(const CleanFace& clean, std::span<const std::uint32_t> corners) {
    const ObjFace& face = scan_.faces[clean.face];
    scene_.polygons.push_back({static_cast<std::uint32_t>(scene_.corners.size()),
                               static_cast<std::uint32_t>(corners.size()), clean.material,
                               face.smoothing_group, clean.face, face.line});
    for (const std::uint32_t c : corners) {
      scene_.corners.push_back(
          {numbers_.corner_positions[c], usableNormal(numbers_.corner_normals[c], face.line)});
    }
  }

  std::uint32_t usableNormal(std::uint32_t n, std::uint32_t line) {
    if (n == kNone) return kNone;
    const double length = glm::length(numbers_.normals[n]);
    if (length > 0 && std::isfinite(length)) return n;
    unusable_normal_.add(line);
    return kNone;
  }

  /// Keeps the points that corners speak of, in the file's order, and moves the scene's frame to their
  /// middle.
  void keepUsedPoints() {
    std::vector<std::uint32_t> new_position(numbers_.positions.size(), kNone);
    std::vector<std::uint32_t> new_normal(numbers_.normals.size(), kNone);
    for (const Corner& corner : scene_.corners) {
      new_position[corner.position] = 0;
      if (corner.normal != kNone) new_normal[corner.normal] = 0;
    }
    for (std::size_t i = 0; i < new_position.size(); ++i) {
      if (new_position[i] == kNone) continue;
      new_position[i] = static_cast<std::uint32_t>(scene_.positions.size());
      scene_.positions.push_back(numbers_.positions[i]);
    }
    for (std::size_t i = 0; i < new_normal.size(); ++i) {
      if (new_normal[i] == kNone) continue;
      new_normal[i] = static_cast<std::uint32_t>(scene_.normals.size());
      scene_.normals.push_back(glm::normalize(numbers_.normals[i]));
    }
    for (Corner& corner : scene_.corners) {
      corner.position = new_position[corner.position];
      if (corner.normal != kNone) corner.normal = new_normal[corner.normal];
    }
    glm::dvec3 low = scene_.positions[0], high = scene_.positions[0];
    for (const glm::dvec3& p : scene_.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    // Halves before the sum: the bounds may be as large as numbers get.
    scene_.frame_origin = 0.5 * low + 0.5 * high;
    for (glm::dvec3& p : scene_.positions) p -= scene_.frame_origin;
    scene_.bounds_min = low - scene_.frame_origin;
    scene_.bounds_max = high - scene_.frame_origin;
  }

  void report() {
    const auto add = [&](Severity severity, const char* code, const Tally& tally, const char* one,
                         const char* many, const std::string& what, const char* advice) {
      if (tally.count == 0) return;
      scene_.diagnostics.push_back({severity, code, counted(tally.count, one, many) + " " + what,
                                    placeOf(scene_.path, tally.first_line), advice});
    };
    add(Severity::kWarning, "degenerate-face", degenerate_, "face", "faces", "without an area dropped",
        "faces need three corners that are not on one line");
    add(Severity::kNote, "repeated-corner", repeated_, "face", "faces",
        "with a corner given twice in a row; the second was left out", "");
    add(Severity::kNote, "non-planar-face", not_planar_, "face", "faces",
        "not planar; each was split into its triangles", "triangulate them yourself to choose the edges");
    add(Severity::kWarning, "self-intersecting-face", not_simple_, "face", "faces",
        "crossing or touching itself; each was replaced by the triangles found",
        "split it into simple polygons");
    add(Severity::kWarning, "duplicate-face", duplicate_, "triangle", "triangles",
        "already there with the same material; dropped", "remove the second copy");
    add(Severity::kWarning, "duplicate-face-material", conflicting_, "triangle", "triangles",
        "already there with another material; the first one counts", "remove the copy that is not meant");
    add(Severity::kWarning, "unusable-normal", unusable_normal_, "corner", "corners",
        "with a normal that has no direction; it is left out", "export the normals again");
  }

  const ObjScan& scan_;
  const ObjNumbers& numbers_;
  const ObjMaterials& materials_;
  Scene& scene_;
  const CancelToken& cancel_;
  std::vector<std::uint32_t> welded_;
  std::vector<CleanFace> faces_;
  std::vector<std::uint32_t> kept_corners_;
  std::vector<FaceTriangle> triangles_;
  Tally degenerate_, repeated_, not_planar_, not_simple_, duplicate_, conflicting_, unusable_normal_;

  // Scratch of one face.
  std::vector<std::uint32_t> loop_;
  std::vector<glm::dvec3> points_;
  std::vector<glm::dvec2> outline_;
};

}  // namespace

void buildPolygons(const ObjScan& scan, const ObjNumbers& numbers, const ObjMaterials& materials,
                   Scene& scene, const CancelToken& cancel) {
  Builder(scan, numbers, materials, scene, cancel).run();
}

}  // namespace unshot
