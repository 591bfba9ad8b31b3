#include "formfactor/patch_polygons.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

#include "formfactor/regions.h"

namespace unshot {
namespace {

// Of the scene's diagonal. Surfaces that meet do so to rounding, and a point beside a patch must not see it
// from above, where it fills half of the view.
constexpr double kMargin = 1e-6;

// A patch of several surfaces is looked at as a few points from farther away than so many radii.
constexpr double kFarJoined = 4;

// Steps of a sequence that spreads evenly with radicalInverse: the inverse of the plastic number.
constexpr double kPlastic = 0.7548776662466927;
// What of a triangle's area is left out towards one corner and its opposite side.
constexpr double kOffBorders = 0.02;

double fraction(double x) { return x - std::floor(x); }

// The bits of k in reverse order behind the point (van der Corput).
double radicalInverse(std::uint32_t k) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= ((k >> bit) & 1u) << (31 - bit);
  return std::ldexp(static_cast<double>(reversed), -32);
}

// The pieces of each of Mesh::patch_shapes, in the order of the cells: those in its node, and slivers that it
// took from cells beside.
std::vector<std::vector<std::uint32_t>> piecesOfPatches(const Mesh& mesh, const CancelToken& cancel) {
  std::vector<std::vector<std::uint32_t>> out(mesh.patch_shapes.size());
  for (const Surface& s : mesh.surfaces) {
    cancel.check();
    if (s.patches.count == 0) continue;
    for (std::uint32_t c = s.first_cell; c < s.first_cell + s.nu * s.nv; ++c) {
      const Range pieces = mesh.cells[c].pieces;
      for (std::uint32_t p = pieces.first; p < pieces.end(); ++p)
        out[s.patches.first + mesh.shapes[s.elements.first + mesh.pieces[p].element].patch].push_back(p);
    }
  }
  return out;
}

}  // namespace

PatchPolygons::PatchPolygons(const Mesh& mesh, const CancelToken& cancel)
    : patches_(mesh.patch_count), margin_(kMargin * glm::length(mesh.bounds_max - mesh.bounds_min)) {
  // The patches of a refined mesh are those of its base, in fewer pieces.
  const Mesh& in = mesh.base ? *mesh.base : mesh;
  const std::vector<std::vector<std::uint32_t>> pieces = piecesOfPatches(in, cancel);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    cancel.check();
    collect(in, q, pieces);
  }
}

// A whole rectangle where the patch is one, else the pieces of its elements.
void PatchPolygons::collect(const Mesh& mesh, std::uint32_t q, const Pieces& pieces) {
  Patch& patch = patches_[q];
  const Region region = regionOfPatch(mesh, q);
  const Surface& middlemost = mesh.surfaces[region.surface];
  patch.surface = mesh.joined(q) ? kNone : region.surface;
  patch.normal = mesh.sides[region.side].normal;
  patch.centre = middlemost.point(region.sample);
  glm::dvec2 low = middlemost.extent, high(0.0);
  std::vector<std::vector<glm::dvec3>> outlines;
  for (const std::uint32_t part : mesh.partsOf(q)) {
    const Side& side = mesh.sides[mesh.patch_parts[part].side];
    const Surface& surface = mesh.surfaces[side.surface];
    for (const std::uint32_t p : pieces[surface.patches.first + mesh.localPatch(part)]) {
      outlines.push_back(outlineOf(mesh, side, mesh.pieces[p]));
      for (const PieceCorner& corner : mesh.cornersOf(mesh.pieces[p])) {
        low = glm::min(low, corner.uv);
        high = glm::max(high, corner.uv);
      }
    }
  }
  const double rectangle = (high.x - low.x) * (high.y - low.y);
  if (!patch.joined() && std::abs(mesh.patch_area[q] - rectangle) <= 1e-9 * rectangle) {
    patch.rectangle = true;
    outlines = {{middlemost.point(low), middlemost.point({high.x, low.y}), middlemost.point(high),
                 middlemost.point({low.x, high.y})}};
    if (mesh.sides[region.side].back) std::reverse(outlines[0].begin(), outlines[0].end());
  }
  for (std::vector<glm::dvec3>& outline : outlines) patch.parts.emplace_back(std::move(outline));
  enclose(patch);
  if (patch.joined()) join(patch);
}

void PatchPolygons::join(Patch& patch) const {
  std::vector<const FactorPolygon*> parts;
  for (const FactorPolygon& part : patch.parts) {
    parts.push_back(&part);
    patch.mean_normal += part.area() * part.normal();
  }
  patch.mean_normal = glm::normalize(patch.mean_normal);
  // Parts meet at corners, which count once.
  for (const FactorPolygon* part : parts)
    patch.corners.insert(patch.corners.end(), part->corners().begin(), part->corners().end());
  const auto cell = [this](const glm::dvec3& p) { return glm::round(p / margin_); };
  const auto before = [&](const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 x = cell(a), y = cell(b);
    return std::tie(x.x, x.y, x.z) < std::tie(y.x, y.y, y.z);
  };
  std::sort(patch.corners.begin(), patch.corners.end(), before);
  patch.corners.erase(std::unique(patch.corners.begin(), patch.corners.end(),
                                  [&](const auto& a, const auto& b) { return cell(a) == cell(b); }),
                      patch.corners.end());
  for (const FactorPolygon* part : parts)
    patch.most_slant = std::max(patch.most_slant, glm::length(glm::cross(patch.mean_normal, part->normal())));
  // Quarters of about as many parts that lie together.
  const auto halve = [](std::span<const FactorPolygon*> in) {
    glm::dvec3 low = in[0]->centre(), high = low;
    for (const FactorPolygon* part : in) {
      low = glm::min(low, part->centre());
      high = glm::max(high, part->centre());
    }
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::stable_sort(in.begin(), in.end(),
                     [axis](auto a, auto b) { return a->centre()[axis] < b->centre()[axis]; });
    return in.size() / 2;
  };
  const auto share = [&](std::span<const FactorPolygon*> in) {
    Share out;
    double area = 0;
    for (const FactorPolygon* part : in) {
      area += part->area();
      out.middle += part->area() * part->centre();
      out.vector_area += part->area() * part->normal();
    }
    out.middle /= area;
    if (area > 0) patch.shares.push_back(out);
  };
  const std::span<const FactorPolygon*> all(parts);
  const std::size_t middle = halve(all);
  for (const std::span<const FactorPolygon*> half : {all.first(middle), all.subspan(middle)}) {
    if (half.size() < 2) {
      share(half);
      continue;
    }
    const std::size_t quarter = halve(half);
    share(half.first(quarter));
    share(half.subspan(quarter));
  }
}

void PatchPolygons::enclose(Patch& patch) const {
  glm::dvec3 low = patch.parts[0].corners()[0], high = low;
  for (const FactorPolygon& part : patch.parts) {
    for (const glm::dvec3& corner : part.corners()) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  patch.middle = (low + high) / 2.0;
  for (const FactorPolygon& part : patch.parts) {
    for (const glm::dvec3& corner : part.corners())
      patch.radius = std::max(patch.radius, glm::length(corner - patch.middle));
  }
}

bool PatchPolygons::isSeen(const Patch& patch, std::uint32_t q, const glm::dvec3& point,
                           const glm::dvec3& normal) const {
  if (!patch.joined() && glm::dot(patch.normal, point - patch.parts[0].centre()) <= margin_) return false;
  // The sphere around it first: it needs no pass over the corners.
  const double height = glm::dot(normal, patch.middle - point);
  if (height <= margin_ - patch.radius) return false;
  if (height > margin_ + patch.radius) return true;
  if (!patch.joined()) return glm::dot(normal, highest(q, normal).at - point) > margin_;
  const double horizon = glm::dot(normal, point) + margin_;
  return std::any_of(patch.corners.begin(), patch.corners.end(),
                     [&](const glm::dvec3& corner) { return glm::dot(normal, corner) > horizon; });
}

// As quickFactor, of a patch of several surfaces.
double PatchPolygons::joinedFactor(const Patch& patch, std::uint32_t q, const glm::dvec3& point,
                                   const glm::dvec3& normal, std::vector<glm::dvec3>& scratch) const {
  const glm::dvec3 to = patch.middle - point;
  const double distance = glm::length(to), facing = -glm::dot(to, patch.mean_normal),
               slant = patch.most_slant * distance + patch.radius;
  if (facing < -slant || !isSeen(patch, q, point, normal)) return 0;
  double sum = 0;
  if (facing > slant && distance > kFarJoined * patch.radius && glm::dot(to, normal) > patch.radius) {
    for (const Share& share : patch.shares) {
      const glm::dvec3 d = share.middle - point;
      const double square = glm::dot(d, d);
      sum -= glm::dot(d, share.vector_area) * glm::dot(d, normal) / (square * square);
    }
    return sum / std::numbers::pi;
  }
  for (const FactorPolygon& part : patch.parts) {
    if (glm::dot(part.normal(), point - part.centre()) > margin_) sum += part.rough(point, normal, scratch);
  }
  return std::max(sum, 0.0);
}

double PatchPolygons::factor(std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal,
                             std::vector<glm::dvec3>& scratch) const {
  const Patch& patch = patches_[q];
  if (!isSeen(patch, q, point, normal)) return 0;
  double sum = 0;
  for (const FactorPolygon& part : patch.parts) {
    if (!patch.joined() || glm::dot(part.normal(), point - part.centre()) > margin_)
      sum += part.exact(point, normal, scratch);
  }
  return std::max(sum, 0.0);
}

double PatchPolygons::quickFactor(std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal,
                                  std::vector<glm::dvec3>& scratch) const {
  const Patch& patch = patches_[q];
  if (patch.joined()) return joinedFactor(patch, q, point, normal, scratch);
  if (!isSeen(patch, q, point, normal)) return 0;
  double sum = 0;
  for (const FactorPolygon& part : patch.parts) sum += part.quick(point, normal, scratch);
  return std::max(sum, 0.0);
}

PatchPolygons::Corner PatchPolygons::highest(std::uint32_t q, const glm::dvec3& direction) const {
  const glm::dvec3* best = nullptr;
  const FactorPolygon* best_part = nullptr;
  double most = 0;
  for (const FactorPolygon& part : patches_[q].parts) {
    for (const glm::dvec3& corner : part.corners()) {
      const double height = glm::dot(direction, corner);
      if (best && height <= most) continue;
      best = &corner;
      best_part = &part;
      most = height;
    }
  }
  return {*best, best_part->centre()};
}

void PatchPolygons::spread(std::uint32_t q, std::uint32_t n, std::vector<glm::dvec3>& out) const {
  const Patch& patch = patches_[q];
  out.clear();
  if (patch.rectangle) {
    const std::vector<glm::dvec3>& ring = patch.parts[0].corners();
    for (std::uint32_t k = 0; k < n; ++k) {
      const double u = (k + 0.5) / n, v = radicalInverse(k) + 0.5 / n;
      out.push_back(ring[0] + u * (ring[1] - ring[0]) + v * (ring[3] - ring[0]));
    }
    return;
  }
  struct Triangle {
    glm::dvec3 a, b, c;
    double until;  // area so far
  };
  std::vector<Triangle> triangles;
  double area = 0;
  for (const FactorPolygon& part : patch.parts) {
    const std::vector<glm::dvec3>& ring = part.corners();
    for (std::size_t k = 2; k < ring.size(); ++k) {
      area += glm::length(glm::cross(ring[k - 1] - ring[0], ring[k] - ring[0])) / 2;
      triangles.push_back({ring[0], ring[k - 1], ring[k], area});
    }
  }
  if (n == 1) {
    out.push_back(patch.centre);
    return;
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    const double at = (k + 0.5) / n * area;
    auto t = std::lower_bound(triangles.begin(), triangles.end(), at,
                              [](const Triangle& triangle, double a) { return triangle.until < a; });
    if (t == triangles.end()) --t;
    // Uniform on a triangle, and off its borders: beyond those may lie another room.
    const double u = fraction(0.5 + k * kPlastic), v = radicalInverse(k) + 0.5 / n;
    const double root = std::sqrt(std::clamp(u, kOffBorders, 1 - kOffBorders));
    out.push_back((1 - root) * t->a + root * (1 - v) * t->b + root * v * t->c);
  }
}

}  // namespace unshot
