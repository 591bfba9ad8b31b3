#include "render/merged_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numeric>
#include <span>
#include <utility>

#include "base/cross.h"

namespace unshot {
namespace {

// Along the side of the largest blocks.
constexpr std::uint32_t kMostCells = 8;
// A vertex that is nearer to a corner of its cell, in cells, is at it; an element as large as its cell but
// for so much fills it.
constexpr double kAtCorner = 1e-3, kFills = 1e-6;

// Vertices of a cell that one element fills: (low, low), (high, low), (high, high), (low, high); the first is
// kNone where it is none.
using Corners = std::array<std::uint32_t, 4>;

class Merger {
 public:
  Merger(const Mesh& mesh, const CancelToken& cancel) : mesh_(mesh), cancel_(cancel) {
    start_.assign(mesh.element_count + 1, 0);
    for (const std::uint32_t e : mesh.triangle_element) ++start_[e + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    of_element_.resize(mesh.triangle_element.size());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t)
      of_element_[next[mesh.triangle_element[t]]++] = t;
  }

  struct Triangles {
    std::vector<std::uint32_t> corners, elements;  // three a triangle; one
  };

  /// In blocks of cells x cells.
  Triangles merged(std::uint32_t cells) {
    Triangles out;
    std::vector<char> done(mesh_.element_count, 0);
    for (const Side& side : mesh_.sides) {
      const Surface& surface = mesh_.surfaces[side.surface];
      findCorners(side, surface);
      for (std::uint32_t j = 0; j < surface.nv; j += cells) {
        cancel_.check();
        for (std::uint32_t i = 0; i < surface.nu; i += cells) {
          const std::uint32_t right = std::min(i + cells, surface.nu), top = std::min(j + cells, surface.nv);
          const bool whole = hangsTogether(surface, i, j, right, top);
          if (whole) addBlock(side, surface, i, j, right, top, out);
          for (std::uint32_t y = j; y < top; ++y) {
            for (std::uint32_t x = i; x < right; ++x) {
              const Range pieces = mesh_.cells[surface.first_cell + y * surface.nu + x].pieces;
              for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
                const std::uint32_t element = side.first_element + mesh_.pieces[p].element;
                if (!std::exchange(done[element], char{1}) && !whole) addElement(element, out);
              }
            }
          }
        }
      }
    }
    return out;
  }

 private:
  std::span<const std::uint32_t> trianglesOf(std::uint32_t element) const {
    return {of_element_.data() + start_[element], of_element_.data() + start_[element + 1]};
  }

  void findCorners(const Side& side, const Surface& surface) {
    const glm::dvec2 step = surface.extent / glm::dvec2(surface.nu, surface.nv);
    corners_.assign(std::size_t{surface.nu} * surface.nv, Corners{kNone, kNone, kNone, kNone});
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      cancel_.check();
      const std::uint32_t local = mesh_.cells[surface.first_cell + c].element;
      if (local == kNone || local == kMixed) continue;
      const double area = mesh_.shapes[surface.elements.first + local].area;
      if (std::abs(area - step.x * step.y) > kFills * step.x * step.y) continue;
      Corners found{kNone, kNone, kNone, kNone};
      for (const std::uint32_t t : trianglesOf(side.first_element + local)) {
        for (std::size_t k = 3 * std::size_t{t}; k < 3 * std::size_t{t} + 3; ++k) {
          const std::uint32_t v = mesh_.triangle_vertices[k];
          const glm::dvec2 at = surface.chart(glm::dvec3(mesh_.vertices[v].position)) / step -
                                glm::dvec2(c % surface.nu, c / surface.nu);
          const bool right = at.x > 0.5, top = at.y > 0.5;
          if (glm::distance(at, glm::dvec2(right, top)) <= kAtCorner)
            found[right != top ? (top ? 3 : 1) : (top ? 2 : 0)] = v;
        }
      }
      if (std::count(found.begin(), found.end(), kNone) == 0) corners_[c] = found;
    }
  }

  // Whether light is continuous over the cells [i, right) x [j, top), and all of them are whole.
  bool hangsTogether(const Surface& surface, std::uint32_t i, std::uint32_t j, std::uint32_t right,
                     std::uint32_t top) const {
    for (std::uint32_t y = j; y < top; ++y) {
      for (std::uint32_t x = i; x < right; ++x) {
        const Corners& here = corners_[y * surface.nu + x];
        if (here[0] == kNone) return false;
        if (x > i) {
          const Corners& left = corners_[y * surface.nu + x - 1];
          if (left[1] != here[0] || left[2] != here[3]) return false;
        }
        if (y > j) {
          const Corners& below = corners_[(y - 1) * surface.nu + x];
          if (below[3] != here[0] || below[2] != here[1]) return false;
        }
      }
    }
    return true;
  }

  void addBlock(const Side& side, const Surface& surface, std::uint32_t i, std::uint32_t j,
                std::uint32_t right, std::uint32_t top, Triangles& out) const {
    const auto cell = [&](std::uint32_t x, std::uint32_t y) { return corners_[y * surface.nu + x]; };
    const Corners ring{cell(i, j)[0], cell(right - 1, j)[1], cell(right - 1, top - 1)[2],
                       cell(i, top - 1)[3]};
    for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
      const std::size_t second = static_cast<std::size_t>(side.back ? c : b),
                        third = static_cast<std::size_t>(side.back ? b : c);
      out.corners.insert(out.corners.end(), {ring[0], ring[second], ring[third]});
      out.elements.push_back(side.first_element +
                             mesh_.cells[surface.first_cell + j * surface.nu + i].element);
    }
  }

  void addElement(std::uint32_t element, Triangles& out) const {
    for (const std::uint32_t t : trianglesOf(element)) {
      const auto corner = mesh_.triangle_vertices.begin() + 3 * static_cast<std::ptrdiff_t>(t);
      out.corners.insert(out.corners.end(), corner, corner + 3);
      out.elements.push_back(element);
    }
  }

  const Mesh& mesh_;
  const CancelToken& cancel_;
  std::vector<std::uint32_t> start_, of_element_;  // triangles by element
  std::vector<Corners> corners_;                   // of the cells of the surface at hand
};

}  // namespace

MergedTriangles mergeTriangles(const Mesh& mesh, std::size_t most, const CancelToken& cancel) {
  MergedTriangles out;
  out.cut = mesh.cut;
  Merger merger(mesh, cancel);
  Merger::Triangles fewest;
  std::size_t count = mesh.triangle_element.size();
  for (std::uint32_t cells = 2; cells <= kMostCells && count > most; cells *= 2) {
    Merger::Triangles merged = merger.merged(cells);
    if (merged.elements.size() >= count) continue;
    count = merged.elements.size();
    fewest = std::move(merged);
  }
  if (fewest.elements.empty()) return out;
  out.blocks = TriangleBlocks(mesh, fewest.corners);
  out.corners = std::make_shared<const std::vector<std::uint32_t>>(std::move(fewest.corners));
  out.elements = std::make_shared<const std::vector<std::uint32_t>>(std::move(fewest.elements));
  return out;
}

}  // namespace unshot
