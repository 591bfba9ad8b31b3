#include "mesh/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <map>
#include <utility>

#include "base/cross.h"
#include "mesh/display.h"
#include "mesh/grid.h"
#include "mesh/numbering.h"
#include "mesh/patch_lattice.h"
#include "mesh/patch_parts.h"

namespace unshot {
namespace {

// Pieces with less than this share of their part's rectangle are rounding.
constexpr double kNoArea = 1e-12;
// Of a part's rectangle: what is smaller is not quartered.
constexpr double kSliver = 1e-5;
// Weights below this are rounding of vertices, which are in single precision.
constexpr double kNoWeight = 1e-4;

class Refiner {
 public:
  // `own_patches`: quarters have patches of their own.
  Refiner(const Mesh& base, Mesh& mesh, bool own_patches, const std::function<bool(const CellPart&)>& split,
          const CancelToken& cancel)
      : base_(base), mesh_(mesh), own_patches_(own_patches), split_(split), cancel_(cancel) {}

  // Returns the base's element of each element, both local to their surfaces, in the order of Mesh::shapes.
  std::vector<std::uint32_t> run() {
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      if (base_.surfaces[s].elements.count > 0) refineSurface(s);
    }
    return std::move(base_element_);
  }

 private:
  struct Part {
    ConvexPolygon polygon;
    std::uint32_t element;  // of the base
  };

  void refineSurface(std::uint32_t s) {
    surface_ = s;
    Surface& surface = mesh_.surfaces[s];
    const Surface& old = base_.surfaces[s];
    surface.elements = {static_cast<std::uint32_t>(mesh_.shapes.size()), 0};
    whole_.assign(old.elements.count, kNone);
    patch_.clear();
    if (own_patches_) {
      surface.patches = {static_cast<std::uint32_t>(mesh_.patch_shapes.size()), 0};
      findNodes(old);
      in_node_.clear();
    }
    const glm::dvec2 step = old.extent / glm::dvec2(old.nu, old.nv);
    std::vector<Part> parts;
    for (std::uint32_t c = 0; c < old.nu * old.nv; ++c) {
      cancel_.check();
      Cell& cell = mesh_.cells[old.first_cell + c];
      cell = {kNone, {static_cast<std::uint32_t>(mesh_.pieces.size()), 0}};
      const Range pieces = base_.cells[old.first_cell + c].pieces;
      parts.clear();
      for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
        const auto corners = base_.piece_corners.begin() + base_.pieces[p].corners.first;
        parts.push_back({{corners, corners + base_.pieces[p].corners.count}, base_.pieces[p].element});
      }
      const glm::dvec2 low = step * glm::dvec2(c % old.nu, c / old.nu);
      cell_ = c;
      refine(parts, low, low + step, 0, 0);
      cell.pieces.count = static_cast<std::uint32_t>(mesh_.pieces.size()) - cell.pieces.first;
      for (std::uint32_t p = cell.pieces.first; p < cell.pieces.end(); ++p) {
        const std::uint32_t element = mesh_.pieces[p].element;
        cell.element = cell.element == kNone || cell.element == element ? element : kMixed;
      }
      surface.cut = surface.cut || cell.pieces.count != pieces.count;
    }
    surface.elements.count = static_cast<std::uint32_t>(mesh_.shapes.size()) - surface.elements.first;
    for (const auto& [key, patch] : patch_) {
      const auto left = patch_.find({0, key.second});
      if (key.first > 0 && left != patch_.end())
        mesh_.patch_shapes[surface.patches.first + left->second].whole = false;
    }
    // All that is left of a patch may be a sliver in the cell beside its node.
    for (std::uint32_t q = 0; own_patches_ && q < surface.patches.count; ++q) {
      if (!in_node_[q]) mesh_.patch_shapes[surface.patches.first + q] = {old.root, false};
    }
    placeCentres(mesh_, surface, cancel_);
  }

  void refine(const std::vector<Part>& parts, const glm::dvec2& low, const glm::dvec2& high,
              std::uint32_t depth, std::uint32_t quartered) {
    if (parts.empty()) return;
    if (depth >= kMostRefined || !asksForMore(parts, low, high, depth)) return store(parts, depth, quartered);
    const glm::dvec2 middle = (low + high) / 2.0;
    // Slivers stay whole: quartered they would be lost to rounding, and with them their patch.
    const double small = kSliver * (high.x - low.x) * (high.y - low.y);
    std::vector<Part> slivers, large;
    for (const Part& part : parts) (polygonArea(part.polygon) < small ? slivers : large).push_back(part);
    store(slivers, depth, quartered);
    quartered = ++quartered_count_;
    ConvexPolygon half, quarter;
    for (int q = 0; q < 4; ++q) {
      const glm::bvec2 above(q & 1, q & 2);
      std::vector<Part> in;
      for (const Part& part : large) {
        clipAt(part.polygon, 0, middle.x, above.x ? 1 : -1, half);
        if (half.empty()) continue;
        clipAt(half, 1, middle.y, above.y ? 1 : -1, quarter);
        if (quarter.empty() || polygonArea(quarter) <= kNoArea * (high.x - low.x) * (high.y - low.y))
          continue;
        in.push_back({quarter, part.element});
      }
      refine(in, glm::mix(low, middle, above), glm::mix(middle, high, above), depth + 1, quartered);
    }
  }

  bool asksForMore(const std::vector<Part>& parts, const glm::dvec2& low, const glm::dvec2& high,
                   std::uint32_t depth) {
    asked_.clear();
    for (const Part& part : parts) asked_.push_back(part.polygon);
    return split_({surface_, low, high, depth, asked_});
  }

  // What was not quartered of an element of the base is one element, wherever it lies; of a quarter, each
  // element of the base in it has its own.
  void store(const std::vector<Part>& parts, std::uint32_t depth, std::uint32_t quartered) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> here;  // of the base, of the mesh
    for (const Part& part : parts) {
      std::uint32_t element = depth == 0 ? whole_[part.element] : kNone;
      for (const auto& [old, made] : here) {
        if (old == part.element) element = made;
      }
      if (element == kNone) {
        element = static_cast<std::uint32_t>(mesh_.shapes.size()) - mesh_.surfaces[surface_].elements.first;
        const ElementShape& old = base_.shapes[base_.surfaces[surface_].elements.first + part.element];
        mesh_.shapes.push_back({0, old.centre, own_patches_ ? ownPatch(old.patch, quartered) : old.patch});
        base_element_.push_back(part.element);
        if (depth == 0) whole_[part.element] = element;
      }
      here.emplace_back(part.element, element);
      if (own_patches_) noteNode(mesh_.shapes[mesh_.surfaces[surface_].elements.first + element].patch);
      const double area = polygonArea(part.polygon);
      mesh_.shapes[mesh_.surfaces[surface_].elements.first + element].area += area;
      mesh_.pieces.push_back({{static_cast<std::uint32_t>(mesh_.piece_corners.size()),
                               static_cast<std::uint32_t>(part.polygon.size())},
                              area,
                              element});
      mesh_.piece_corners.insert(mesh_.piece_corners.end(), part.polygon.begin(), part.polygon.end());
    }
  }

  // What `old` is in a cell (0) or in a part that was quartered.
  std::uint32_t ownPatch(std::uint32_t old, std::uint32_t quartered) {
    Range& patches = mesh_.surfaces[surface_].patches;
    const auto [found, made] = patch_.try_emplace({quartered, old}, patches.count);
    if (made) {
      const PatchShape& shape = base_.patch_shapes[base_.surfaces[surface_].patches.first + old];
      mesh_.patch_shapes.push_back(quartered == 0 ? shape : PatchShape{node_of_cell_[cell_], false});
      ++patches.count;
    }
    return found->second;
  }

  void noteNode(std::uint32_t patch) {
    if (patch >= in_node_.size()) in_node_.resize(patch + 1, 0);
    if (mesh_.patch_shapes[mesh_.surfaces[surface_].patches.first + patch].node == node_of_cell_[cell_])
      in_node_[patch] = 1;
  }

  // The nodes of the patches, which tile the cells: a piece may belong to a patch of the cell beside.
  void findNodes(const Surface& old) {
    node_of_cell_.assign(old.nu * old.nv, old.root);
    for (std::uint32_t q = old.patches.first; q < old.patches.end(); ++q) {
      const Node& node = base_.nodes[base_.patch_shapes[q].node];
      for (std::uint32_t v = node.v0; v < node.v1; ++v) {
        for (std::uint32_t u = node.u0; u < node.u1; ++u)
          node_of_cell_[v * old.nu + u] = base_.patch_shapes[q].node;
      }
    }
  }

  const Mesh& base_;
  Mesh& mesh_;
  const bool own_patches_;
  const std::function<bool(const CellPart&)>& split_;
  const CancelToken& cancel_;
  std::uint32_t surface_ = 0;
  std::vector<std::uint32_t> whole_;  // element of what is not quartered of each of the base
  std::vector<std::uint32_t> base_element_;
  std::uint32_t cell_ = 0, quartered_count_ = 0;
  std::vector<std::uint32_t> node_of_cell_;
  std::vector<char> in_node_;  // one per patch: some of it lies in its node
  // Of the part that was quartered (0: none) and the base's patch, that of the mesh; local to the surface.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> patch_;
  std::vector<ConvexPolygon> asked_;
};

// Of each of `count` keys, the indices k with key(k) equal to it.
struct Buckets {
  std::vector<std::uint32_t> start, index;

  template <class F>
  Buckets(std::size_t count, std::size_t size, F&& key) : start(count + 1, 0), index(size) {
    for (std::uint32_t k = 0; k < size; ++k) ++start[key(k) + 1];
    for (std::size_t b = 0; b < count; ++b) start[b + 1] += start[b];
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::uint32_t k = 0; k < size; ++k) index[next[key(k)]++] = k;
  }
  std::span<const std::uint32_t> operator[](std::size_t b) const {
    return {index.data() + start[b], index.data() + start[b + 1]};
  }
};

// Rows of weights from the base's vertices: quadratic over patches that are whole rectangles, else linear in
// the base's display triangle that holds the vertex.
class Interpolation {
 public:
  Interpolation(const Mesh& mesh, const CancelToken& cancel)
      : mesh_(mesh),
        base_(*mesh.base),
        cancel_(cancel),
        lattices_(patchLattices(base_, cancel)),
        triangles_(base_.element_count, base_.triangle_element.size(),
                   [&](std::uint32_t t) { return base_.triangle_element[t]; }) {}

  SparseRows run() {
    std::vector<std::uint32_t> element(mesh_.vertices.size(), kNone);
    for (std::size_t k = 0; k < mesh_.triangle_vertices.size(); ++k)
      element[mesh_.triangle_vertices[k]] = mesh_.triangle_element[k / 3];
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      cancel_.check();
      if (element[v] != kNone) addRow(mesh_.vertices[v], element[v]);
      rows_.start.push_back(static_cast<std::uint32_t>(rows_.index.size()));
    }
    return std::move(rows_);
  }

 private:
  void addRow(const Vertex& vertex, std::uint32_t element) {
    const Side& side = mesh_.sides[mesh_.element_side[element]];
    const Surface& surface = mesh_.surfaces[side.surface];
    const glm::dvec2 at = surface.chart(glm::dvec3(vertex.position));
    if (const auto& lattice = lattices_[mesh_.element_patch[element]]) {
      add(lattice->weightsAt(at), lattice->vertex.data(), lattice->size());
      return;
    }
    double best = -std::numeric_limits<double>::infinity();
    std::array<double, 9> weights{};
    const std::uint32_t* corners = nullptr;
    for (const std::uint32_t t : triangles_[mesh_.element_from_base[element]]) {
      const std::uint32_t* vertices = &base_.triangle_vertices[3 * t];
      std::array<glm::dvec2, 3> p;
      for (std::size_t c = 0; c < 3; ++c)
        p[c] = surface.chart(glm::dvec3(base_.vertices[vertices[c]].position));
      const double whole = cross(p[1] - p[0], p[2] - p[0]);
      if (whole == 0) continue;
      const std::array<double, 9> w{cross(p[1] - at, p[2] - at) / whole, cross(p[2] - at, p[0] - at) / whole,
                                    cross(p[0] - at, p[1] - at) / whole};
      const double least = std::min({w[0], w[1], w[2]});
      if (least <= best) continue;
      best = least;
      weights = w;
      corners = vertices;
    }
    for (double& w : weights) w = std::max(w, 0.0);
    if (corners) add(weights, corners, 3);
  }

  void add(const std::array<double, 9>& weights, const std::uint32_t* vertices, std::size_t n) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += std::abs(weights[k]) < kNoWeight ? 0 : weights[k];
    for (std::size_t k = 0; k < n; ++k) {
      if (std::abs(weights[k]) < kNoWeight) continue;
      rows_.index.push_back(vertices[k]);
      rows_.weight.push_back(static_cast<float>(weights[k] / sum));
    }
  }

  const Mesh& mesh_;
  const Mesh& base_;
  const CancelToken& cancel_;
  std::vector<std::optional<PatchLattice>> lattices_;
  Buckets triangles_;
  SparseRows rows_;
};

// A copy without what is made of elements.
Mesh withoutElements(const Mesh& base) {
  Mesh mesh = base;
  mesh.pieces.clear();
  mesh.piece_corners.clear();
  mesh.shapes.clear();
  mesh.vertices.clear();
  mesh.triangle_vertices.clear();
  mesh.triangle_element.clear();
  mesh.vertex_from_elements = {};
  return mesh;
}

}  // namespace

bool asksForAny(const Mesh& base, const std::function<bool(const CellPart&)>& split) {
  std::vector<ConvexPolygon> pieces;
  for (std::uint32_t s = 0; s < base.surfaces.size(); ++s) {
    const Surface& surface = base.surfaces[s];
    if (surface.elements.count == 0) continue;
    const glm::dvec2 step = surface.extent / glm::dvec2(surface.nu, surface.nv);
    for (std::uint32_t c = 0; c < surface.nu * surface.nv; ++c) {
      const Range range = base.cells[surface.first_cell + c].pieces;
      if (range.count == 0) continue;
      pieces.clear();
      for (std::uint32_t p = range.first; p < range.end(); ++p) {
        const std::span<const PieceCorner> corners = base.cornersOf(base.pieces[p]);
        pieces.emplace_back(corners.begin(), corners.end());
      }
      const glm::dvec2 low = step * glm::dvec2(c % surface.nu, c / surface.nu);
      if (split({s, low, low + step, 0, pieces})) return true;
    }
  }
  return false;
}

Mesh refineMesh(std::shared_ptr<const Mesh> base, const std::function<bool(const CellPart&)>& split,
                const CancelToken& cancel) {
  Mesh mesh = withoutElements(*base);
  const std::vector<std::uint32_t> of_shape = Refiner(*base, mesh, false, split, cancel).run();
  mesh.base = std::move(base);
  numberElements(mesh, cancel);
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const std::uint32_t shape = mesh.surfaces[side.surface].elements.first + e - side.first_element;
    mesh.element_from_base.push_back(mesh.base->sides[mesh.element_side[e]].first_element + of_shape[shape]);
  }
  makeDisplay(mesh, cancel);
  joinPatchesAs(*mesh.base, mesh);
  mesh.vertex_from_base = Interpolation(mesh, cancel).run();
  return mesh;
}

Mesh gradedMesh(const Mesh& uniform, const std::function<bool(const CellPart&)>& split,
                const CancelToken& cancel) {
  Mesh mesh = withoutElements(uniform);
  mesh.patch_shapes.clear();
  Refiner(uniform, mesh, true, split, cancel).run();
  numberElements(mesh, cancel);
  makeDisplay(mesh, cancel);
  joinSmallPatches(mesh, cancel);
  return mesh;
}

}  // namespace unshot
