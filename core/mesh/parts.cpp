#include "mesh/parts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cross.h"

namespace unshot {
namespace {

class PartFinder {
 public:
  PartFinder(const Mesh& mesh, const Surface& surface, const CancelToken& cancel)
      : mesh_(mesh),
        surface_(surface),
        cancel_(cancel),
        step_(surface.extent / glm::dvec2(surface.nu, surface.nv)) {
    near_ = 1e-9 * std::min(step_.x, step_.y);
  }

  PartGraph run() {
    const std::uint32_t cells = surface_.nu * surface_.nv;
    if (cells > 0) first_piece_ = mesh_.cells[surface_.first_cell].pieces.first;
    for (std::uint32_t c = 0; c < cells; ++c) partsOfCell(c);
    collectBorders();
    return std::move(out_);
  }

 private:
  const PieceCorner& corner(const Piece& piece, std::uint32_t k) const {
    return mesh_.piece_corners[piece.corners.first + k % piece.corners.count];
  }

  bool shareEdge(const Piece& a, const Piece& b) const {
    for (std::uint32_t i = 0; i < a.corners.count; ++i) {
      if (corner(a, i).outline) continue;
      const glm::dvec2 p = corner(a, i).uv, d = corner(a, i + 1).uv - p;
      const double length = glm::length(d);
      if (length <= near_) continue;
      for (std::uint32_t j = 0; j < b.corners.count; ++j) {
        if (corner(b, j).outline) continue;
        const glm::dvec2 q0 = corner(b, j).uv - p, q1 = corner(b, j + 1).uv - p;
        if (std::abs(cross(d, q0)) > near_ * length || std::abs(cross(d, q1)) > near_ * length) continue;
        const double t0 = glm::dot(q0, d) / length, t1 = glm::dot(q1, d) / length;
        if (std::min(std::max(t0, t1), length) - std::max(std::min(t0, t1), 0.0) > near_) return true;
      }
    }
    return false;
  }

  // Pairs of pieces (their numbers in the cell, the smaller first) whose bounds meet: a surface of many small
  // triangles has hundreds in a cell.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> besideEachOther(const Range& pieces) const {
    if (pieces.count < 2) return {};
    struct Bounds {
      glm::dvec2 low{INFINITY}, high{-INFINITY};
      std::uint32_t piece = 0;
    };
    std::vector<Bounds> bounds(pieces.count);
    for (std::uint32_t k = 0; k < pieces.count; ++k) {
      bounds[k].piece = k;
      for (const PieceCorner& c : mesh_.cornersOf(mesh_.pieces[pieces.first + k])) {
        bounds[k].low = glm::min(bounds[k].low, c.uv - near_);
        bounds[k].high = glm::max(bounds[k].high, c.uv + near_);
      }
    }
    std::sort(bounds.begin(), bounds.end(),
              [](const Bounds& a, const Bounds& b) { return a.low.x < b.low.x; });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      cancel_.check();
      for (std::size_t j = i + 1; j < bounds.size() && bounds[j].low.x <= bounds[i].high.x; ++j) {
        if (bounds[j].low.y > bounds[i].high.y || bounds[j].high.y < bounds[i].low.y) continue;
        pairs.push_back(std::minmax(bounds[i].piece, bounds[j].piece));
      }
    }
    return pairs;
  }

  void partsOfCell(std::uint32_t c) {
    cancel_.check();
    const Range pieces = mesh_.cells[surface_.first_cell + c].pieces;
    std::vector<std::uint32_t> group(pieces.count);
    std::iota(group.begin(), group.end(), 0u);
    const auto find = [&](std::uint32_t k) {
      while (group[k] != k) k = group[k] = group[group[k]];
      return k;
    };
    for (const auto& [i, j] : besideEachOther(pieces)) {
      if (find(i) != find(j) && shareEdge(mesh_.pieces[pieces.first + i], mesh_.pieces[pieces.first + j])) {
        group[find(j)] = find(i);
      }
    }
    std::vector<std::uint32_t> part(pieces.count, kNone);
    for (std::uint32_t k = 0; k < pieces.count; ++k) {
      std::uint32_t& index = part[find(k)];
      if (index == kNone) {
        index = static_cast<std::uint32_t>(out_.parts.size());
        out_.parts.push_back({c, 0.0});
      }
      out_.parts[index].area += mesh_.pieces[pieces.first + k].area;
      out_.piece_part.push_back(index);
    }
  }

  // A piece's edge on a grid line: interval [low, high] along it.
  struct LineEdge {
    std::uint32_t axis, line;
    bool above;  // the piece lies on the side of larger coordinates
    double low, high;
    std::uint32_t part;
  };

  void collectBorders() {
    std::vector<LineEdge> edges;
    for (std::uint32_t k = 0; k < out_.piece_part.size(); ++k) {
      cancel_.check();
      const Piece& piece = mesh_.pieces[first_piece_ + k];
      const std::uint32_t part = out_.piece_part[k], c = out_.parts[part].cell;
      const std::uint32_t cell_index[2] = {c % surface_.nu, c / surface_.nu};
      for (std::uint32_t i = 0; i < piece.corners.count; ++i) {
        if (corner(piece, i).outline) continue;
        const glm::dvec2 p = corner(piece, i).uv, q = corner(piece, i + 1).uv;
        for (std::uint32_t axis = 0; axis < 2; ++axis) {
          for (std::uint32_t above = 0; above < 2; ++above) {
            const std::uint32_t line = cell_index[axis] + 1 - above;
            const double at = line * step_[axis];
            if (std::abs(p[axis] - at) > near_ || std::abs(q[axis] - at) > near_) continue;
            const double x = p[1 - axis], y = q[1 - axis];
            if (std::abs(x - y) > near_)
              edges.push_back({axis, line, above == 1, std::min(x, y), std::max(x, y), part});
          }
        }
      }
    }
    std::sort(edges.begin(), edges.end(), cancel_.checking([](const LineEdge& a, const LineEdge& b) {
      return std::tie(a.axis, a.line, a.low) < std::tie(b.axis, b.line, b.low);
    }));
    for (std::size_t i = 0; i < edges.size(); ++i) {
      cancel_.check();
      for (std::size_t j = i + 1; j < edges.size(); ++j) {
        const LineEdge &a = edges[i], &b = edges[j];
        if (a.axis != b.axis || a.line != b.line || b.low >= a.high) break;
        const double length = std::min(a.high, b.high) - b.low;
        if (a.above != b.above && length > near_) out_.borders.push_back({a.part, b.part, length});
      }
    }
  }

  const Mesh& mesh_;
  const Surface& surface_;
  const CancelToken& cancel_;
  glm::dvec2 step_;
  double near_ = 0;
  std::uint32_t first_piece_ = 0;
  PartGraph out_;
};

}  // namespace

PartGraph findParts(const Mesh& mesh, const Surface& surface, const CancelToken& cancel) {
  return PartFinder(mesh, surface, cancel).run();
}

}  // namespace unshot
