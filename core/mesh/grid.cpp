#include "mesh/grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/clip.h"

namespace unshot {
namespace {

class SurfaceGrid {
 public:
  SurfaceGrid(Mesh& mesh, std::uint32_t surface, std::uint32_t patch_cells)
      : mesh_(mesh), surface_index_(surface), surface_(mesh.surfaces[surface]), patch_cells_(patch_cells) {}

  void run(std::uint32_t nu, std::uint32_t nv) {
    surface_.nu = nu;
    surface_.nv = nv;
    du_ = surface_.extent.x / nu;
    dv_ = surface_.extent.y / nv;
    surface_.first_cell = static_cast<std::uint32_t>(mesh_.cells.size());
    mesh_.cells.resize(mesh_.cells.size() + std::size_t{nu} * nv);
    clipTriangles();
    storePieces();
    joinSlivers();
    makeTree();
    makeElements();
  }

 private:
  struct LoosePiece {
    std::uint32_t cell;
    std::uint32_t first, count;
    double area;
  };

  Cell& cell(std::uint32_t local) { return mesh_.cells[surface_.first_cell + local]; }

  void clipTriangles() {
    ConvexPolygon triangle, left, band, right, piece;
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
        clipBand(triangle, 1, j, surface_.nv, dv_, left, band);
        if (band.empty()) continue;
        const auto [u_low, u_high] = range(band, 0);
        const std::uint32_t i1 = index(u_high, du_, surface_.nu);
        for (std::uint32_t i = index(u_low, du_, surface_.nu); i <= i1; ++i) {
          clipBand(band, 0, i, surface_.nu, du_, right, piece);
          const double area = piece.empty() ? 0 : polygonArea(piece);
          if (area <= smallest) continue;
          loose_.push_back({j * surface_.nu + i, static_cast<std::uint32_t>(corners_.size()),
                            static_cast<std::uint32_t>(piece.size()), area});
          corners_.insert(corners_.end(), piece.begin(), piece.end());
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

  void storePieces() {
    std::stable_sort(loose_.begin(), loose_.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
    const std::size_t cells = std::size_t{surface_.nu} * surface_.nv;
    area_.assign(cells, 0.0);
    for (std::size_t c = 0; c < cells; ++c) cell(static_cast<std::uint32_t>(c)).pieces.first = pieceCount();
    for (std::size_t k = 0; k < loose_.size(); ++k) {
      const LoosePiece& piece = loose_[k];
      Cell& target = cell(piece.cell);
      if (target.pieces.count == 0) target.pieces.first = pieceCount();
      ++target.pieces.count;
      area_[piece.cell] += piece.area;
      mesh_.pieces.push_back({{static_cast<std::uint32_t>(mesh_.piece_corners.size()), piece.count}, piece.area});
      mesh_.piece_corners.insert(mesh_.piece_corners.end(), corners_.begin() + piece.first,
                                 corners_.begin() + piece.first + piece.count);
    }
  }

  std::uint32_t pieceCount() const { return static_cast<std::uint32_t>(mesh_.pieces.size()); }

  std::uint32_t find(std::uint32_t c) {
    while (group_[c] != c) c = group_[c] = group_[group_[c]];
    return c;
  }

  // Length of the border of cell c on the grid line to its left (0), right (1), below (2), above (3).
  std::array<double, 4> borders(std::uint32_t c) const {
    const std::uint32_t i = c % surface_.nu, j = c / surface_.nu;
    const std::array<double, 4> line{i * du_, (i + 1) * du_, j * dv_, (j + 1) * dv_};
    const std::array<double, 4> near{1e-9 * du_, 1e-9 * du_, 1e-9 * dv_, 1e-9 * dv_};
    std::array<double, 4> out{};
    const Range pieces = mesh_.cells[surface_.first_cell + c].pieces;
    for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
      const Range corners = mesh_.pieces[p].corners;
      for (std::uint32_t k = 0; k < corners.count; ++k) {
        const glm::dvec2 a = mesh_.piece_corners[corners.first + k].uv;
        const glm::dvec2 b = mesh_.piece_corners[corners.first + (k + 1) % corners.count].uv;
        for (int s = 0; s < 4; ++s) {
          const int axis = s / 2;
          if (std::abs(a[axis] - line[s]) < near[s] && std::abs(b[axis] - line[s]) < near[s]) {
            out[s] += std::abs(a[1 - axis] - b[1 - axis]);
          }
        }
      }
    }
    return out;
  }

  void joinSlivers() {
    const auto cells = static_cast<std::uint32_t>(area_.size());
    group_.resize(cells);
    std::iota(group_.begin(), group_.end(), 0u);
    group_area_ = area_;
    const double enough = kSliverShare * du_ * dv_;
    std::vector<std::uint32_t> small;
    for (std::uint32_t c = 0; c < cells; ++c) {
      if (area_[c] > 0 && area_[c] < enough) small.push_back(c);
    }
    std::sort(small.begin(), small.end(), [&](auto a, auto b) { return area_[a] < area_[b]; });
    for (const std::uint32_t c : small) {
      if (group_area_[find(c)] >= enough) continue;
      const auto border = borders(c);
      const std::uint32_t i = c % surface_.nu, j = c / surface_.nu;
      std::uint32_t best = kNone;
      double longest = 0;
      for (int s = 0; s < 4; ++s) {
        if ((s == 0 && i == 0) || (s == 1 && i + 1 == surface_.nu) || (s == 2 && j == 0) ||
            (s == 3 && j + 1 == surface_.nv)) {
          continue;
        }
        const std::uint32_t other = s == 0 ? c - 1 : s == 1 ? c + 1 : s == 2 ? c - surface_.nu : c + surface_.nu;
        if (area_[other] <= 0 || find(other) == find(c) || border[s] <= longest) continue;
        longest = border[s];
        best = other;
      }
      if (best == kNone) continue;
      const std::uint32_t from = find(c), to = find(best);
      group_[from] = to;
      group_area_[to] += group_area_[from];
    }
  }

  void makeTree() {
    surface_.patches.first = static_cast<std::uint32_t>(mesh_.patch_nodes.size());
    surface_.root = static_cast<std::uint32_t>(mesh_.nodes.size());
    cell_patch_.assign(area_.size(), kNone);
    Node root;
    root.surface = surface_index_;
    root.u1 = surface_.nu;
    root.v1 = surface_.nv;
    mesh_.nodes.push_back(root);
    grow(surface_.root, kNone);
  }

  // Children halve a node along both sides, or along the longer one where it is at least twice the other.
  void grow(std::uint32_t index, std::uint32_t patch) {
    Node node = mesh_.nodes[index];
    const std::uint32_t wide = node.u1 - node.u0, high = node.v1 - node.v0;
    if (patch == kNone && wide <= patch_cells_ && high <= patch_cells_) {
      patch = static_cast<std::uint32_t>(mesh_.patch_nodes.size()) - surface_.patches.first;
      mesh_.patch_nodes.push_back(index);
    }
    if (node.isCell()) {
      const std::uint32_t c = node.v0 * surface_.nu + node.u0;
      cell_patch_[c] = patch;
      mesh_.nodes[index].area = area_[c];
      return;
    }
    const double size_u = wide * du_, size_v = high * dv_;
    const bool split_u = wide > 1 && (high == 1 || size_u * 2 > size_v);
    const bool split_v = high > 1 && (wide == 1 || size_v * 2 > size_u);
    const std::uint32_t mid_u = split_u ? node.u0 + wide / 2 : node.u1;
    const std::uint32_t mid_v = split_v ? node.v0 + high / 2 : node.v1;
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
      grow(first + k, patch);
      area += mesh_.nodes[first + k].area;
    }
    mesh_.nodes[index].first_child = first;
    mesh_.nodes[index].child_count = count;
    mesh_.nodes[index].area = area;
  }

  void makeElements() {
    surface_.elements.first = static_cast<std::uint32_t>(mesh_.shapes.size());
    const auto cells = static_cast<std::uint32_t>(area_.size());
    std::vector<std::uint32_t> element_of_group(cells, kNone);
    std::vector<glm::dvec2> moment;
    std::vector<double> largest_cell, largest_piece;
    std::vector<glm::dvec2> largest_centre;
    for (std::uint32_t c = 0; c < cells; ++c) {
      if (area_[c] <= 0) continue;
      std::uint32_t& element = element_of_group[find(c)];
      if (element == kNone) {
        element = static_cast<std::uint32_t>(mesh_.shapes.size()) - surface_.elements.first;
        mesh_.shapes.emplace_back();
        moment.emplace_back(0.0);
        largest_cell.push_back(0);
        largest_piece.push_back(0);
        largest_centre.emplace_back(0.0);
      }
      cell(c).element = element;
      ElementShape& shape = mesh_.shapes[surface_.elements.first + element];
      shape.area += area_[c];
      if (area_[c] > largest_cell[element]) {
        largest_cell[element] = area_[c];
        shape.patch = cell_patch_[c];
      }
      for (std::uint32_t p = cell(c).pieces.first; p < cell(c).pieces.end(); ++p) {
        const Piece& piece = mesh_.pieces[p];
        const glm::dvec2 centre = polygonCentroid({&mesh_.piece_corners[piece.corners.first], piece.corners.count});
        moment[element] += piece.area * centre;
        if (piece.area > largest_piece[element]) {
          largest_piece[element] = piece.area;
          largest_centre[element] = centre;
        }
      }
    }
    surface_.elements.count = static_cast<std::uint32_t>(moment.size());
    placeCentres(moment, largest_centre);
    dropEmptyPatches();
  }

  // The centroid, or where that falls outside the element, the centre of its largest piece.
  void placeCentres(const std::vector<glm::dvec2>& moment, const std::vector<glm::dvec2>& largest_centre) {
    for (std::uint32_t e = 0; e < surface_.elements.count; ++e) {
      ElementShape& shape = mesh_.shapes[surface_.elements.first + e];
      const glm::dvec2 centroid = moment[e] / shape.area;
      const Cell& at = mesh_.cells[cellAt(surface_, centroid)];
      bool inside = false;
      if (at.element == e) {
        for (std::uint32_t p = at.pieces.first; p < at.pieces.end() && !inside; ++p) {
          const Range corners = mesh_.pieces[p].corners;
          inside = contains({&mesh_.piece_corners[corners.first], corners.count}, centroid);
        }
      }
      shape.centre = surface_.point(inside ? centroid : largest_centre[e]);
    }
  }

  void dropEmptyPatches() {
    const std::uint32_t all = static_cast<std::uint32_t>(mesh_.patch_nodes.size()) - surface_.patches.first;
    std::vector<std::uint32_t> renumbered(all, kNone);
    for (std::uint32_t e = 0; e < surface_.elements.count; ++e) {
      renumbered[mesh_.shapes[surface_.elements.first + e].patch] = 0;
    }
    std::uint32_t kept = 0;
    for (std::uint32_t p = 0; p < all; ++p) {
      if (renumbered[p] == kNone) continue;
      renumbered[p] = kept;
      mesh_.patch_nodes[surface_.patches.first + kept++] = mesh_.patch_nodes[surface_.patches.first + p];
    }
    mesh_.patch_nodes.resize(surface_.patches.first + kept);
    surface_.patches.count = kept;
    for (std::uint32_t e = 0; e < surface_.elements.count; ++e) {
      ElementShape& shape = mesh_.shapes[surface_.elements.first + e];
      shape.patch = renumbered[shape.patch];
    }
  }

  Mesh& mesh_;
  std::uint32_t surface_index_;
  Surface& surface_;
  std::uint32_t patch_cells_;
  double du_ = 0, dv_ = 0;
  std::vector<LoosePiece> loose_;
  std::vector<PieceCorner> corners_;
  std::vector<double> area_, group_area_;     // per cell
  std::vector<std::uint32_t> group_;          // union-find over cells
  std::vector<std::uint32_t> cell_patch_;     // local patch of each cell
};

}  // namespace

void gridSurface(Mesh& mesh, std::uint32_t surface, std::uint32_t nu, std::uint32_t nv, std::uint32_t patch_cells) {
  SurfaceGrid(mesh, surface, patch_cells).run(nu, nv);
}

}  // namespace unshot
