#include "mesh/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "base/point_tree.h"
#include "mesh/air.h"
#include "mesh/vertex_weights.h"
#include "mesh/weld.h"
#include "scene/triangulate.h"

namespace unshot {
namespace {

class DisplayMaker {
 public:
  DisplayMaker(Mesh& mesh, const CancelToken& cancel)
      : mesh_(mesh), distance_(mesh.weld_distance), cancel_(cancel) {}

  void run() {
    findPoints();
    cancel_.report(0.2);
    makeRings();
    cancel_.report(0.4);
    const std::vector<PieceEdge> edges = pieceEdges();
    joinAir(mesh_, edges, points_, cancel_);
    cancel_.report(0.6);
    joinCorners(edges);
    cancel_.report(0.8);
    numberVertices();
    makeTriangles();
    makeWeights();
  }

 private:
  const PieceCorner& corner(const Piece& piece, std::uint32_t k) const {
    return mesh_.piece_corners[piece.corners.first + k % piece.corners.count];
  }

  // Every piece's corners in space, coinciding ones made one.
  void findPoints() {
    std::vector<glm::dvec3> all;
    all.reserve(mesh_.piece_corners.size());
    piece_surface_.resize(mesh_.pieces.size());
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      const Surface& surface = mesh_.surfaces[s];
      cancel_.check();
      if (surface.elements.count == 0) continue;
      for (std::uint32_t c = surface.first_cell; c < surface.first_cell + surface.nu * surface.nv; ++c) {
        const Range pieces = mesh_.cells[c].pieces;
        for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
          piece_surface_[p] = s;
          for (std::uint32_t k = 0; k < mesh_.pieces[p].corners.count; ++k) {
            all.push_back(surface.point(corner(mesh_.pieces[p], k).uv));
          }
        }
      }
    }
    const std::vector<std::uint32_t> representative = mergePoints(all, distance_, cancel_.part(0, 0.2));
    corner_point_.resize(all.size());
    for (std::uint32_t k = 0; k < all.size(); ++k) {
      if (representative[k] == k) {
        corner_point_[k] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(all[k]);
      } else {
        corner_point_[k] = corner_point_[representative[k]];
      }
    }
  }

  // A corner of a piece in its ring: the point and whether the edge to the next one is outline. A point that
  // lies on an edge of the piece, because a neighbour has a corner there, is put in between the edge's ends.
  struct RingCorner {
    std::uint32_t point;
    bool outline;
    std::uint32_t from = kNone,
                  to = kNone;  // ring corners of the edge it was put in; kNone for a corner of the piece
    float along = 0;
    bool putIn() const { return from != kNone; }
  };

  void makeRings() {
    // A neighbour may be divided differently on outlines, and within surfaces that contacts cut.
    const auto cut = [&](std::uint32_t piece) { return mesh_.surfaces[piece_surface_[piece]].cut; };
    std::vector<std::uint32_t> candidates;
    std::vector<char> marked(points_.size(), 0);
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      cancel_.check();
      const Range corners = mesh_.pieces[p].corners;
      for (std::uint32_t k = corners.first; k < corners.end(); ++k) {
        const bool before = mesh_.piece_corners[k > corners.first ? k - 1 : corners.end() - 1].outline;
        if (!mesh_.piece_corners[k].outline && !before && !cut(p)) continue;
        if (!std::exchange(marked[corner_point_[k]], char{1})) candidates.push_back(corner_point_[k]);
      }
    }
    std::vector<glm::dvec3> places;
    for (const std::uint32_t p : candidates) places.push_back(points_[p]);
    const PointTree tree(places, cancel_);
    std::vector<std::pair<double, std::uint32_t>> between;
    ring_start_.push_back(0);
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      cancel_.check();
      const Piece& piece = mesh_.pieces[p];
      for (std::uint32_t k = 0; k < piece.corners.count; ++k) {
        const std::uint32_t a = corner_point_[piece.corners.first + k];
        const std::uint32_t b = corner_point_[piece.corners.first + (k + 1) % piece.corners.count];
        if (a == b) continue;
        const bool outline = corner(piece, k).outline;
        ring_.push_back({a, outline});
        if (!outline && !cut(p)) continue;
        const glm::dvec3 d = points_[b] - points_[a];
        const double length = glm::length(d);
        between.clear();
        tree.nearSegment(points_[a], points_[b], 2 * distance_, [&](std::uint32_t found) {
          const double along = glm::dot(places[found] - points_[a], d) / length;
          if (along > distance_ && along < length - distance_) between.emplace_back(along, candidates[found]);
        });
        std::sort(between.begin(), between.end());
        const auto from = static_cast<std::uint32_t>(ring_.size()) - 1;
        for (const auto& [along, point] : between) {
          if (point == a || point == b || ring_.back().point == point) continue;
          ring_.push_back({point, outline, from, kNone, static_cast<float>(along / length)});
        }
      }
      closeRing(ring_start_.back());
    }
  }

  // Points put in know the end of their edge: the next corner of the piece around the ring.
  void closeRing(std::uint32_t first) {
    const auto end = static_cast<std::uint32_t>(ring_.size());
    std::uint32_t next = first;
    for (std::uint32_t k = end; k-- > first;) {
      if (ring_[k].putIn()) {
        ring_[k].to = next;
      } else {
        next = k;
      }
    }
    ring_start_.push_back(end);
  }

  std::uint32_t find(std::uint32_t c) {
    while (group_[c] != c) c = group_[c] = group_[group_[c]];
    return c;
  }

  std::vector<PieceEdge> pieceEdges() const {
    std::vector<PieceEdge> edges;
    edges.reserve(ring_.size());
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      cancel_.check();
      for (std::uint32_t k = ring_start_[p]; k < ring_start_[p + 1]; ++k) {
        const std::uint32_t next = k + 1 < ring_start_[p + 1] ? k + 1 : ring_start_[p];
        const bool forward = ring_[k].point < ring_[next].point;
        const std::uint32_t low = forward ? k : next, high = forward ? next : k;
        edges.push_back({ring_[low].point, ring_[high].point, low, high, p, piece_surface_[p],
                         ring_[k].outline, forward});
      }
    }
    std::sort(edges.begin(), edges.end(), cancel_.checking([](const PieceEdge& a, const PieceEdge& b) {
      return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    }));
    return edges;
  }

  // Ring corners are one vertex where pieces share an edge across which light is continuous: within a surface
  // an edge that is not outline, between surfaces an edge of a smooth pair. Side by side: group 2 corner +
  // back.
  void joinCorners(const std::vector<PieceEdge>& edges) {
    std::set<std::tuple<std::uint32_t, std::uint32_t, bool>> smooth;
    for (const SmoothPair& pair : mesh_.smooth_pairs)
      smooth.emplace(std::min(pair.a, pair.b), std::max(pair.a, pair.b), pair.flipped);
    group_.resize(2 * ring_.size());
    std::iota(group_.begin(), group_.end(), 0u);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      cancel_.check();
      for (std::size_t j = i + 1;
           j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high; ++j) {
        const PieceEdge &a = edges[i], &b = edges[j];
        if (a.surface == b.surface) {
          if (!a.outline && !b.outline) joinEdge(a, b, 0);
          continue;
        }
        const std::uint32_t first = std::min(a.surface, b.surface), second = std::max(a.surface, b.surface);
        if (smooth.count({first, second, false}) != 0) joinEdge(a, b, 0);
        if (smooth.count({first, second, true}) != 0) joinEdge(a, b, 1);
      }
    }
  }

  void joinEdge(const PieceEdge& a, const PieceEdge& b, std::uint32_t flip) {
    for (std::uint32_t back = 0; back < 2; ++back) {
      group_[find(2 * a.at_low + back)] = find(2 * b.at_low + (back ^ flip));
      group_[find(2 * a.at_high + back)] = find(2 * b.at_high + (back ^ flip));
    }
  }

  void numberVertices() {
    vertex_.assign(group_.size(), kNone);
    std::vector<std::uint32_t> of_group(group_.size(), kNone);
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      cancel_.check();
      const Surface& surface = mesh_.surfaces[piece_surface_[p]];
      for (std::uint32_t k = ring_start_[p]; k < ring_start_[p + 1]; ++k) {
        for (std::uint32_t back = 0; back < 2; ++back) {
          if (surface.side[back] == kNone) continue;
          std::uint32_t& vertex = of_group[find(2 * k + back)];
          if (vertex == kNone) {
            vertex = static_cast<std::uint32_t>(mesh_.vertices.size());
            mesh_.vertices.push_back(
                {glm::vec3(points_[ring_[k].point]), glm::vec3(0.0f), surface.material, surface.side[back]});
          }
          vertex_[2 * k + back] = vertex;
        }
      }
    }
  }

  void makeTriangles() {
    std::vector<glm::dvec2> outline;
    std::vector<glm::dvec3> normals(mesh_.vertices.size(), glm::dvec3(0.0));  // areas overflow floats
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      cancel_.check();
      const Surface& surface = mesh_.surfaces[piece_surface_[p]];
      outline.clear();
      for (std::uint32_t k = ring_start_[p]; k < ring_start_[p + 1]; ++k) {
        outline.push_back(surface.chart(points_[ring_[k].point]));
      }
      const auto triangles = triangulate(outline);
      for (std::uint32_t back = 0; back < 2; ++back) {
        const std::uint32_t side = surface.side[back];
        if (side == kNone) continue;
        for (auto t : triangles) {
          if (back) std::swap(t[1], t[2]);
          for (const std::uint32_t k : t) {
            const std::uint32_t vertex = vertex_[2 * (ring_start_[p] + k) + back];
            mesh_.triangle_vertices.push_back(vertex);
            normals[vertex] += mesh_.pieces[p].area * mesh_.sides[side].normal;
          }
          mesh_.triangle_element.push_back(mesh_.sides[side].first_element + mesh_.pieces[p].element);
        }
      }
    }
    for (std::size_t k = 0; k < normals.size(); ++k) {
      Vertex& v = mesh_.vertices[k];
      const double length = glm::length(normals[k]);
      v.normal = glm::vec3(length > 0 ? normals[k] / length : mesh_.sides[v.side].normal);
    }
  }

  using Entry = VertexWeight;
  using Rows = std::vector<std::vector<Entry>>;

  // Elements around a vertex count by the inverse of their centre's distance. A vertex that is only put in
  // takes the values of its edge's ends, so that putting it in changes nothing that is seen.
  void makeWeights() {
    Rows rows(mesh_.vertices.size());
    std::vector<char> real(mesh_.vertices.size(), 0);
    for (std::uint32_t k = 0; k < ring_.size(); ++k) {
      for (std::uint32_t back = 0; back < 2; ++back) {
        if (!ring_[k].putIn() && vertex_[2 * k + back] != kNone) real[vertex_[2 * k + back]] = 1;
      }
    }
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      cancel_.check();
      const Surface& surface = mesh_.surfaces[piece_surface_[p]];
      const glm::dvec3 centre = mesh_.shapes[surface.elements.first + mesh_.pieces[p].element].centre;
      for (std::uint32_t k = ring_start_[p]; k < ring_start_[p + 1]; ++k) {
        const double distance = std::max(glm::distance(centre, points_[ring_[k].point]), 1e-6 * distance_);
        for (std::uint32_t back = 0; back < 2; ++back) {
          const std::uint32_t side = surface.side[back], vertex = vertex_[2 * k + back];
          if (side == kNone || !real[vertex]) continue;
          const std::uint32_t element = mesh_.sides[side].first_element + mesh_.pieces[p].element;
          auto& row = rows[vertex];
          const bool known =
              std::any_of(row.begin(), row.end(), [&](const Entry& e) { return e.element == element; });
          if (!known) row.push_back({element, static_cast<float>(distance_ / distance)});
        }
      }
    }
    for (auto& row : rows) {
      cancel_.check();
      float sum = 0;
      for (const Entry& e : row) sum += e.weight;
      for (Entry& e : row) e.weight /= sum;
    }
    interpolateInCells(rows);
    interpolateAlongEdges(real, rows);
    for (const auto& row : rows) {
      cancel_.check();
      for (const Entry& e : row) {
        mesh_.vertex_from_elements.index.push_back(e.element);
        mesh_.vertex_from_elements.weight.push_back(e.weight);
      }
      mesh_.vertex_from_elements.start.push_back(
          static_cast<std::uint32_t>(mesh_.vertex_from_elements.index.size()));
    }
  }

  // Ring corners of the cell's pieces at its four corners: (low, low), (high, low), (low, high), (high,
  // high); kNone where the cell is clipped there.
  std::array<std::uint32_t, 4> gridCorners(const Surface& surface, std::uint32_t cell) const {
    const glm::dvec2 step = surface.extent / glm::dvec2(surface.nu, surface.nv);
    const glm::dvec2 low = step * glm::dvec2(cell % surface.nu, cell / surface.nu);
    std::array<std::uint32_t, 4> out{kNone, kNone, kNone, kNone};
    const Range pieces = mesh_.cells[surface.first_cell + cell].pieces;
    for (std::uint32_t k = ring_start_[pieces.first]; k < ring_start_[pieces.end()]; ++k) {
      const glm::dvec2 t = (surface.chart(points_[ring_[k].point]) - low) / step;
      const glm::dvec2 nearest = glm::clamp(glm::round(t), 0.0, 1.0);
      if (glm::distance(t * step, nearest * step) > 2 * distance_) continue;
      out[static_cast<std::size_t>(nearest.x + 2 * nearest.y)] = k;
    }
    return out;
  }

  // What the triangles of the input and the corners of neighbours cut into a whole cell is bilinear between
  // its corners, so that such cuts do not show.
  void interpolateInCells(Rows& rows) const {
    std::vector<char> done(rows.size(), 0);
    for (const Surface& surface : mesh_.surfaces) {
      const glm::dvec2 step = surface.extent / glm::dvec2(surface.nu, surface.nv);
      for (std::uint32_t c = 0; surface.elements.count > 0 && c < surface.nu * surface.nv; ++c) {
        cancel_.check();
        const Cell& cell = mesh_.cells[surface.first_cell + c];
        if (cell.element == kNone || cell.element == kMixed) continue;
        const std::uint32_t first = ring_start_[cell.pieces.first], end = ring_start_[cell.pieces.end()];
        if (end - first <= 4) continue;
        const auto corners = gridCorners(surface, c);
        if (std::count(corners.begin(), corners.end(), kNone) != 0) continue;
        const glm::dvec2 low = step * glm::dvec2(c % surface.nu, c / surface.nu);
        for (std::uint32_t k = first; k < end; ++k) {
          const bool at_corner = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
            return ring_[corner].point == ring_[k].point;
          });
          if (at_corner) continue;
          const glm::dvec2 t = glm::clamp((surface.chart(points_[ring_[k].point]) - low) / step, 0.0, 1.0);
          for (std::uint32_t back = 0; back < 2; ++back) {
            const std::uint32_t vertex = vertex_[2 * k + back];
            if (vertex == kNone || std::exchange(done[vertex], char{1})) continue;
            // At the weld distance a vertex that is put in may pass for a corner.
            const auto unknown = [&](std::uint32_t q) { return rows[vertex_[2 * q + back]].empty(); };
            if (std::any_of(corners.begin(), corners.end(), unknown)) continue;
            std::vector<Entry> row;
            for (std::uint32_t q = 0; q < 4; ++q) {
              const double share = (q & 1 ? t.x : 1 - t.x) * (q & 2 ? t.y : 1 - t.y);
              for (const Entry& e : rows[vertex_[2 * corners[q] + back]]) {
                row.push_back({e.element, static_cast<float>(share) * e.weight});
              }
            }
            if (row.size() > kManyVertexWeights) mergeEqual(row);
            if (row.size() <= kManyVertexWeights) rows[vertex] = std::move(row);
          }
        }
      }
    }
  }

  void interpolateAlongEdges(const std::vector<char>& real, Rows& rows) const {
    for (std::uint32_t k = 0; k < ring_.size(); ++k) {
      cancel_.check();
      if (!ring_[k].putIn()) continue;
      for (std::uint32_t back = 0; back < 2; ++back) {
        const std::uint32_t vertex = vertex_[2 * k + back];
        if (vertex == kNone || real[vertex] || !rows[vertex].empty()) continue;
        for (const Entry& e : rows[vertex_[2 * ring_[k].from + back]]) {
          rows[vertex].push_back({e.element, (1 - ring_[k].along) * e.weight});
        }
        for (const Entry& e : rows[vertex_[2 * ring_[k].to + back]]) {
          rows[vertex].push_back({e.element, ring_[k].along * e.weight});
        }
        if (rows[vertex].size() > kManyVertexWeights) mergeEqual(rows[vertex]);
      }
    }
  }

  Mesh& mesh_;
  double distance_;
  const CancelToken& cancel_;
  std::vector<std::uint32_t> piece_surface_;  // per piece
  std::vector<glm::dvec3> points_;
  std::vector<std::uint32_t> corner_point_;  // per piece corner
  std::vector<RingCorner> ring_;
  std::vector<std::uint32_t> ring_start_;  // per piece
  std::vector<std::uint32_t> group_;       // union-find over 2 ring corner + back
  std::vector<std::uint32_t> vertex_;  // display vertex of 2 ring corner + back; kNone: that side is not lit
};

}  // namespace

void makeDisplay(Mesh& mesh, const CancelToken& cancel) { DisplayMaker(mesh, cancel).run(); }

}  // namespace unshot
