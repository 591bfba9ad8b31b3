#include "mesh/grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "mesh/clip.h"
#include "mesh/parts.h"

namespace unshot {
namespace {

class Groups {  // union-find
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::uint32_t from, std::uint32_t to) { parent_[find(from)] = find(to); }

 private:
  std::vector<std::uint32_t> parent_;
};

class SurfaceGrid {
 public:
  SurfaceGrid(Mesh& mesh, std::uint32_t surface, std::uint32_t patch_cells, bool paired,
              const std::vector<ContactSegment>& contacts, double tolerance, const CancelToken& cancel)
      : mesh_(mesh),
        surface_index_(surface),
        surface_(mesh.surfaces[surface]),
        patch_cells_(patch_cells),
        paired_(paired),
        contacts_(contacts),
        tolerance_(tolerance),
        cancel_(cancel) {}

  void run(std::uint32_t nu, std::uint32_t nv) {
    surface_.nu = nu;
    surface_.nv = nv;
    surface_.cut = false;
    du_ = surface_.extent.x / nu;
    dv_ = surface_.extent.y / nv;
    surface_.first_cell = static_cast<std::uint32_t>(mesh_.cells.size());
    mesh_.cells.resize(mesh_.cells.size() + std::size_t{nu} * nv);
    std::vector<std::vector<ConvexPolygon>> in_cell(std::size_t{nu} * nv);
    clipTriangles(in_cell);
    storePieces(in_cell);
    const PartGraph graph = findParts(mesh_, surface_, cancel_);
    makeElements(graph);
    makeTree(graph);
    makePatches(graph);
  }

 private:
  Cell& cell(std::uint32_t local) { return mesh_.cells[surface_.first_cell + local]; }

  void clipTriangles(std::vector<std::vector<ConvexPolygon>>& in_cell) const {
    ConvexPolygon triangle, scratch, band, piece;
    const double smallest = 1e-12 * du_ * dv_;
    const auto index = [](double x, double step, std::uint32_t n) {
      return std::min(static_cast<std::uint32_t>(std::max(x / step, 0.0)), n - 1);
    };
    for (std::uint32_t t = surface_.triangles.first; t < surface_.triangles.end(); ++t) {
      const ChartTriangle& source = mesh_.triangles[t];
      triangle.clear();
      for (int k = 0; k < 3; ++k) triangle.push_back({source.uv[k], source.outline[k]});
      const auto [v_low, v_high] = range(triangle, 1);
      const std::uint32_t j1 = index(v_high, dv_, surface_.nv);
      for (std::uint32_t j = index(v_low, dv_, surface_.nv); j <= j1; ++j) {
        cancel_.check();
        clipBand(triangle, 1, j, surface_.nv, dv_, scratch, band);
        if (band.empty()) continue;
        const auto [u_low, u_high] = range(band, 0);
        const std::uint32_t i1 = index(u_high, du_, surface_.nu);
        for (std::uint32_t i = index(u_low, du_, surface_.nu); i <= i1; ++i) {
          clipBand(band, 0, i, surface_.nu, du_, scratch, piece);
          if (!piece.empty() && polygonArea(piece) > smallest) in_cell[j * surface_.nu + i].push_back(piece);
        }
      }
    }
  }

  static std::pair<double, double> range(const ConvexPolygon& p, int axis) {
    double low = p[0].uv[axis], high = low;
    for (const PieceCorner& c : p) {
      low = std::min(low, c.uv[axis]);
      high = std::max(high, c.uv[axis]);
    }
    return {low, high};
  }

  // Band k of n along an axis; the outermost lines do not clip, so that rounding at the border loses nothing.
  static void clipBand(const ConvexPolygon& in, int axis, std::uint32_t k, std::uint32_t n, double step,
                       ConvexPolygon& scratch, ConvexPolygon& out) {
    if (k > 0) {
      clipAt(in, axis, k * step, 1, scratch);
    } else {
      scratch = in;
    }
    if (k + 1 < n) {
      clipAt(scratch, axis, (k + 1) * step, -1, out);
    } else {
      out = scratch;
    }
  }

  void storePieces(std::vector<std::vector<ConvexPolygon>>& in_cell) {
    for (std::uint32_t c = 0; c < in_cell.size(); ++c) {
      cancel_.check();
      Range& pieces = cell(c).pieces;
      pieces.first = static_cast<std::uint32_t>(mesh_.pieces.size());
      const std::size_t uncut = in_cell[c].size();
      if (!contacts_.empty()) cutByContacts(in_cell[c], contacts_, tolerance_);
      surface_.cut = surface_.cut || in_cell[c].size() != uncut;
      for (const ConvexPolygon& p : in_cell[c]) {
        mesh_.pieces.push_back(
            {{static_cast<std::uint32_t>(mesh_.piece_corners.size()), static_cast<std::uint32_t>(p.size())},
             polygonArea(p),
             0});
        mesh_.piece_corners.insert(mesh_.piece_corners.end(), p.begin(), p.end());
        ++pieces.count;
      }
    }
  }

  // Joins parts too small to be elements to the neighbour with the longest common border, smallest first.
  Groups joinSlivers(const PartGraph& graph) const {
    Groups groups(graph.parts.size());
    std::vector<std::vector<PartBorder>> around(graph.parts.size());
    for (const PartBorder& b : graph.borders) {
      around[b.a].push_back(b);
      around[b.b].push_back({b.b, b.a, b.length});
    }
    const double enough = kSliverShare * du_ * dv_;
    std::vector<double> area;
    std::vector<std::uint32_t> small;
    for (std::uint32_t p = 0; p < graph.parts.size(); ++p) {
      area.push_back(graph.parts[p].area);
      if (area[p] < enough) small.push_back(p);
    }
    std::sort(small.begin(), small.end(),
              [&](auto a, auto b) { return graph.parts[a].area < graph.parts[b].area; });
    for (const std::uint32_t p : small) {
      cancel_.check();
      const std::uint32_t own = groups.find(p);
      if (area[own] >= enough) continue;
      std::uint32_t best = kNone;
      double longest = 0;
      for (const PartBorder& b : around[p]) {
        if (groups.find(b.b) == own || b.length <= longest) continue;
        longest = b.length;
        best = groups.find(b.b);
      }
      if (best == kNone) continue;
      groups.join(own, best);
      area[best] += area[own];
    }
    return groups;
  }

  void makeElements(const PartGraph& graph) {
    Groups groups = joinSlivers(graph);
    surface_.elements.first = static_cast<std::uint32_t>(mesh_.shapes.size());
    std::vector<std::uint32_t> element_of_group(graph.parts.size(), kNone);
    std::vector<double> largest_part;
    part_element_.resize(graph.parts.size());
    for (std::uint32_t p = 0; p < graph.parts.size(); ++p) {
      cancel_.check();
      std::uint32_t& element = element_of_group[groups.find(p)];
      if (element == kNone) {
        element = static_cast<std::uint32_t>(main_part_.size());
        mesh_.shapes.emplace_back();
        main_part_.push_back(p);
        largest_part.push_back(0);
      }
      part_element_[p] = element;
      mesh_.shapes[surface_.elements.first + element].area += graph.parts[p].area;
      if (graph.parts[p].area > largest_part[element]) {
        largest_part[element] = graph.parts[p].area;
        main_part_[element] = p;
      }
    }
    surface_.elements.count = static_cast<std::uint32_t>(main_part_.size());
    for (std::uint32_t c = 0; c < surface_.nu * surface_.nv; ++c) {
      cancel_.check();
      Cell& target = cell(c);
      for (std::uint32_t k = target.pieces.first; k < target.pieces.end(); ++k) {
        const std::uint32_t element = part_element_[graph.piece_part[k - firstPiece()]];
        mesh_.pieces[k].element = element;
        target.element = target.element == kNone || target.element == element ? element : kMixed;
      }
    }
    placeCentres(mesh_, surface_, cancel_);
  }

  std::uint32_t firstPiece() const { return mesh_.cells[surface_.first_cell].pieces.first; }

  void makeTree(const PartGraph& graph) {
    surface_.root = static_cast<std::uint32_t>(mesh_.nodes.size());
    cell_patch_node_.assign(std::size_t{surface_.nu} * surface_.nv, kNone);
    cell_area_.assign(cell_patch_node_.size(), 0.0);
    for (const Part& p : graph.parts) cell_area_[p.cell] += p.area;
    Node root;
    root.surface = surface_index_;
    root.u1 = surface_.nu;
    root.v1 = surface_.nv;
    mesh_.nodes.push_back(root);
    grow(surface_.root, kNone);
  }

  std::uint32_t halfOf(std::uint32_t cells) const {
    return paired_ && cells > 2 ? 2 * ((cells + 2) / 4) : cells / 2;
  }

  // Children halve a node along both sides, or along the longer one where it is at least twice the other.
  void grow(std::uint32_t index, std::uint32_t patch_node) {
    cancel_.check();
    const Node node = mesh_.nodes[index];
    const std::uint32_t wide = node.u1 - node.u0, high = node.v1 - node.v0;
    if (patch_node == kNone && wide <= patch_cells_ && high <= patch_cells_) patch_node = index;
    if (node.isCell()) {
      const std::uint32_t c = node.v0 * surface_.nu + node.u0;
      cell_patch_node_[c] = patch_node;
      mesh_.nodes[index].area = cell_area_[c];
      return;
    }
    const double size_u = wide * du_, size_v = high * dv_;
    const bool split_u = wide > 1 && (high == 1 || size_u * 2 > size_v);
    const bool split_v = high > 1 && (wide == 1 || size_v * 2 > size_u);
    const std::uint32_t mid_u = split_u ? node.u0 + halfOf(wide) : node.u1;
    const std::uint32_t mid_v = split_v ? node.v0 + halfOf(high) : node.v1;
    const auto first = static_cast<std::uint32_t>(mesh_.nodes.size());
    for (int q = 0; q < 4; ++q) {
      Node child = node;
      (q & 1 ? child.u0 : child.u1) = mid_u;
      (q & 2 ? child.v0 : child.v1) = mid_v;
      if (child.u0 < child.u1 && child.v0 < child.v1) mesh_.nodes.push_back(child);
    }
    const std::uint32_t count = static_cast<std::uint32_t>(mesh_.nodes.size()) - first;
    double area = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      grow(first + k, patch_node);
      area += mesh_.nodes[first + k].area;
    }
    mesh_.nodes[index].first_child = first;
    mesh_.nodes[index].child_count = count;
    mesh_.nodes[index].area = area;
  }

  // A patch is what hangs together of the elements whose largest part lies in the same node.
  void makePatches(const PartGraph& graph) {
    const std::uint32_t n = surface_.elements.count;
    std::vector<std::uint32_t> node(n);
    for (std::uint32_t e = 0; e < n; ++e) node[e] = cell_patch_node_[graph.parts[main_part_[e]].cell];
    Groups groups(n);
    for (const PartBorder& b : graph.borders) {
      const std::uint32_t x = part_element_[b.a], y = part_element_[b.b];
      if (node[x] == node[y]) groups.join(x, y);
    }
    surface_.patches.first = static_cast<std::uint32_t>(mesh_.patch_shapes.size());
    std::vector<std::uint32_t> patch_of_group(n, kNone);
    for (std::uint32_t e = 0; e < n; ++e) {
      cancel_.check();
      std::uint32_t& patch = patch_of_group[groups.find(e)];
      if (patch == kNone) {
        patch = static_cast<std::uint32_t>(mesh_.patch_shapes.size()) - surface_.patches.first;
        mesh_.patch_shapes.push_back({node[e], true});
      }
      mesh_.shapes[surface_.elements.first + e].patch = patch;
    }
    surface_.patches.count = static_cast<std::uint32_t>(mesh_.patch_shapes.size()) - surface_.patches.first;
    for (std::uint32_t p = 0; p < graph.parts.size(); ++p) {
      const std::uint32_t patch_node = cell_patch_node_[graph.parts[p].cell];
      PatchShape& own = mesh_.patch_shapes[surface_.patches.first +
                                           mesh_.shapes[surface_.elements.first + part_element_[p]].patch];
      if (own.node != patch_node) own.whole = false;
    }
    markSharedNodes(graph);
  }

  // A node that holds pieces of several patches is whole for none of them.
  void markSharedNodes(const PartGraph& graph) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> seen;  // node, patch
    for (std::uint32_t p = 0; p < graph.parts.size(); ++p) {
      seen.emplace_back(cell_patch_node_[graph.parts[p].cell],
                        mesh_.shapes[surface_.elements.first + part_element_[p]].patch);
    }
    std::sort(seen.begin(), seen.end(), cancel_.checking(std::less<>()));
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const bool alone = (k == 0 || seen[k - 1].first != seen[k].first) &&
                         (k + 1 == seen.size() || seen[k + 1].first != seen[k].first);
      if (!alone) mesh_.patch_shapes[surface_.patches.first + seen[k].second].whole = false;
    }
  }

  Mesh& mesh_;
  std::uint32_t surface_index_;
  Surface& surface_;
  std::uint32_t patch_cells_;
  bool paired_;
  const std::vector<ContactSegment>& contacts_;
  double tolerance_;
  const CancelToken& cancel_;
  double du_ = 0, dv_ = 0;
  std::vector<std::uint32_t> part_element_;     // local element of each part
  std::vector<std::uint32_t> main_part_;        // largest part of each element
  std::vector<std::uint32_t> cell_patch_node_;  // the node that is a patch above each cell
  std::vector<double> cell_area_;
};

}  // namespace

void gridSurface(Mesh& mesh, std::uint32_t surface, std::uint32_t nu, std::uint32_t nv,
                 std::uint32_t patch_cells, bool paired, const std::vector<ContactSegment>& contacts,
                 double tolerance, const CancelToken& cancel) {
  SurfaceGrid(mesh, surface, patch_cells, paired, contacts, tolerance, cancel).run(nu, nv);
}

void placeCentres(Mesh& mesh, const Surface& surface, const CancelToken& cancel) {
  const std::uint32_t n = surface.elements.count;
  std::vector<glm::dvec2> moment(n, glm::dvec2(0.0)), largest_centre(n, glm::dvec2(0.0));
  std::vector<double> largest(n, 0.0);
  for (std::uint32_t k = mesh.cells[surface.first_cell].pieces.first; k < mesh.pieces.size(); ++k) {
    const Piece& piece = mesh.pieces[k];
    const glm::dvec2 centre = polygonCentroid(mesh.cornersOf(piece));
    moment[piece.element] += piece.area * centre;
    if (piece.area <= largest[piece.element]) continue;
    largest[piece.element] = piece.area;
    largest_centre[piece.element] = centre;
  }
  for (std::uint32_t e = 0; e < n; ++e) {
    cancel.check();
    ElementShape& shape = mesh.shapes[surface.elements.first + e];
    const glm::dvec2 centroid = moment[e] / shape.area;
    bool inside = false;
    const Range pieces = mesh.cells[cellAt(surface, centroid)].pieces;
    for (std::uint32_t k = pieces.first; k < pieces.end() && !inside; ++k)
      inside = mesh.pieces[k].element == e && contains(mesh.cornersOf(mesh.pieces[k]), centroid);
    shape.centre = surface.point(inside ? centroid : largest_centre[e]);
  }
}

std::uint32_t elementAt(const Mesh& mesh, const Surface& s, const glm::dvec2& uv, double margin) {
  const Cell& cell = mesh.cells[cellAt(s, uv)];
  if (cell.element != kMixed) return cell.element;
  // Most positions lie well inside a piece, and one edge shows of most pieces that they do not hold it.
  for (std::uint32_t k = cell.pieces.first; k < cell.pieces.end(); ++k) {
    const std::span<const PieceCorner> corners = mesh.cornersOf(mesh.pieces[k]);
    if (contains(corners, uv) && distanceOutside(corners, uv) <= -margin) return mesh.pieces[k].element;
  }
  std::uint32_t best = kNone, other = kNone;
  double least = INFINITY, least_other = INFINITY;
  for (std::uint32_t k = cell.pieces.first; k < cell.pieces.end(); ++k) {
    const std::uint32_t element = mesh.pieces[k].element;
    const double outside = distanceOutside(mesh.cornersOf(mesh.pieces[k]), uv);
    if (outside < least) {
      if (element != best) {
        other = best;
        least_other = least;
      }
      least = outside;
      best = element;
    } else if (element != best && outside < least_other) {
      other = element;
      least_other = outside;
    }
  }
  return other != kNone && least_other < margin ? kNone : best;
}

}  // namespace unshot
