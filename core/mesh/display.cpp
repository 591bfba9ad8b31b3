#include "mesh/display.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "base/point_tree.h"
#include "mesh/weld.h"
#include "scene/triangulate.h"

namespace unshot {
namespace {

// A vertex of one surface, whatever the side. One that is no corner of a piece but lies on an edge of one (because a
// neighbour has a corner there) interpolates between the ends of that edge.
struct LocalVertex {
  std::uint32_t point;
  std::uint32_t parent[2] = {kNone, kNone};  // local vertices; kNone for a corner
  float along = 0;                           // 0 at parent[0], 1 at parent[1]
  bool corner() const { return parent[0] == kNone; }
};

class DisplayMaker {
 public:
  DisplayMaker(Mesh& mesh, std::span<const SmoothPair> pairs, double distance)
      : mesh_(mesh), pairs_(pairs), distance_(distance) {}

  void run() {
    findPoints();
    makeRings();
    makeLocalVertices();
    shareVertices();
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
    piece_element_.resize(mesh_.pieces.size());
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      const Surface& surface = mesh_.surfaces[s];
      if (surface.elements.count == 0) continue;
      for (std::uint32_t c = surface.first_cell; c < surface.first_cell + surface.nu * surface.nv; ++c) {
        const Range pieces = mesh_.cells[c].pieces;
        for (std::uint32_t p = pieces.first; p < pieces.end(); ++p) {
          piece_surface_[p] = s;
          piece_element_[p] = mesh_.cells[c].element;
          for (std::uint32_t k = 0; k < mesh_.pieces[p].corners.count; ++k) {
            all.push_back(surface.point(corner(mesh_.pieces[p], k).uv));
          }
        }
      }
    }
    const std::vector<std::uint32_t> representative = mergePoints(all, distance_);
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

  // The ring of points around each piece, with what lies on its outline edges put in.
  void makeRings() {
    std::vector<std::uint32_t> on_outline;
    std::vector<char> marked(points_.size(), 0);
    for (std::size_t k = 0; k < corner_point_.size(); ++k) {
      if (!mesh_.piece_corners[k].outline || marked[corner_point_[k]]) continue;
      marked[corner_point_[k]] = 1;
      on_outline.push_back(corner_point_[k]);
    }
    std::vector<glm::dvec3> places;
    for (const std::uint32_t p : on_outline) places.push_back(points_[p]);
    const PointTree tree(places);
    std::vector<std::pair<double, std::uint32_t>> between;
    ring_start_.push_back(0);
    for (const Piece& piece : mesh_.pieces) {
      for (std::uint32_t k = 0; k < piece.corners.count; ++k) {
        const std::uint32_t a = corner_point_[piece.corners.first + k];
        const std::uint32_t b = corner_point_[piece.corners.first + (k + 1) % piece.corners.count];
        if (a == b) continue;
        ring_.push_back({a, kNone, kNone, 0.0f});
        if (!corner(piece, k).outline) continue;
        const glm::dvec3 d = points_[b] - points_[a];
        const double length = glm::length(d);
        between.clear();
        tree.nearSegment(points_[a], points_[b], 2 * distance_, [&](std::uint32_t found) {
          const double along = glm::dot(places[found] - points_[a], d) / length;
          if (along > distance_ && along < length - distance_) between.emplace_back(along, on_outline[found]);
        });
        std::sort(between.begin(), between.end());
        for (const auto& [along, point] : between) {
          if (point == a || point == b || ring_.back().point == point) continue;
          ring_.push_back({point, a, b, static_cast<float>(along / length)});
        }
      }
      ring_start_.push_back(static_cast<std::uint32_t>(ring_.size()));
    }
  }

  struct RingPoint {
    std::uint32_t point;
    std::uint32_t from, to;  // ends of the edge it was put in; kNone for a corner
    float along;
  };

  std::uint32_t localVertex(std::uint32_t surface, std::uint32_t point) const {
    const auto first = local_.begin() + local_start_[surface], end = local_.begin() + local_start_[surface + 1];
    const auto found = std::lower_bound(first, end, point, [](const LocalVertex& v, std::uint32_t p) { return v.point < p; });
    return static_cast<std::uint32_t>(found - local_.begin());
  }

  void makeLocalVertices() {
    std::uint32_t piece = 0;
    local_start_.push_back(0);
    std::vector<LocalVertex> own;
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      own.clear();
      for (; piece < mesh_.pieces.size() && piece_surface_[piece] == s; ++piece) {
        for (std::uint32_t k = ring_start_[piece]; k < ring_start_[piece + 1]; ++k) {
          own.push_back({ring_[k].point, {ring_[k].from, ring_[k].to}, ring_[k].along});
        }
      }
      // A corner of any piece comes before the same point on an edge.
      std::sort(own.begin(), own.end(), [](const LocalVertex& a, const LocalVertex& b) {
        return std::make_tuple(a.point, !a.corner()) < std::make_tuple(b.point, !b.corner());
      });
      own.erase(std::unique(own.begin(), own.end(), [](auto& a, auto& b) { return a.point == b.point; }), own.end());
      local_.insert(local_.end(), own.begin(), own.end());
      local_start_.push_back(static_cast<std::uint32_t>(local_.size()));
    }
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      for (std::uint32_t v = local_start_[s]; v < local_start_[s + 1]; ++v) {
        for (std::uint32_t& parent : local_[v].parent) {
          if (parent != kNone) parent = localVertex(s, parent);
        }
      }
    }
  }

  std::uint32_t find(std::uint32_t c) {
    while (group_[c] != c) c = group_[c] = group_[group_[c]];
    return c;
  }

  // Joins the vertices of smooth neighbours, side by side: group 2 v + back.
  void shareVertices() {
    group_.resize(2 * local_.size());
    std::iota(group_.begin(), group_.end(), 0u);
    shared_.assign(local_.size(), 0);
    for (const SmoothPair& pair : pairs_) {
      std::uint32_t a = local_start_[pair.a], b = local_start_[pair.b];
      while (a < local_start_[pair.a + 1] && b < local_start_[pair.b + 1]) {
        if (local_[a].point != local_[b].point) {
          ++(local_[a].point < local_[b].point ? a : b);
          continue;
        }
        shared_[a] = shared_[b] = 1;
        for (std::uint32_t back = 0; back < 2; ++back) {
          group_[find(2 * a + back)] = find(2 * b + (back ^ static_cast<std::uint32_t>(pair.flipped)));
        }
        ++a;
        ++b;
      }
    }
  }

  void numberVertices() {
    vertex_.assign(group_.size(), kNone);
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      for (std::uint32_t back = 0; back < 2; ++back) {
        const std::uint32_t side = mesh_.surfaces[s].side[back];
        if (side == kNone) continue;
        for (std::uint32_t v = local_start_[s]; v < local_start_[s + 1]; ++v) {
          std::uint32_t& vertex = vertex_[find(2 * v + back)];
          if (vertex == kNone) {
            vertex = static_cast<std::uint32_t>(mesh_.vertices.size());
            mesh_.vertices.push_back({glm::vec3(points_[local_[v].point]), glm::vec3(0.0f), mesh_.surfaces[s].material, side});
          }
          vertex_[2 * v + back] = vertex;
        }
      }
    }
  }

  void makeTriangles() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<glm::dvec2> outline;
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      const Surface& surface = mesh_.surfaces[piece_surface_[p]];
      outline.clear();
      for (std::uint32_t k = ring_start_[p]; k < ring_start_[p + 1]; ++k) {
        const glm::dvec3 d = points_[ring_[k].point] - surface.origin;
        outline.emplace_back(glm::dot(d, surface.axis_u), glm::dot(d, surface.axis_v));
      }
      triangles = triangulate(outline);
      for (std::uint32_t back = 0; back < 2; ++back) {
        const std::uint32_t side = surface.side[back];
        if (side == kNone) continue;
        for (auto t : triangles) {
          if (back) std::swap(t[1], t[2]);
          for (const std::uint32_t k : t) {
            const std::uint32_t v = localVertex(piece_surface_[p], ring_[ring_start_[p] + k].point);
            const std::uint32_t vertex = vertex_[2 * v + back];
            mesh_.triangle_vertices.push_back(vertex);
            mesh_.vertices[vertex].normal += glm::vec3(mesh_.sides[side].normal * mesh_.pieces[p].area);
          }
          mesh_.triangle_element.push_back(mesh_.sides[side].first_element + piece_element_[p]);
        }
      }
    }
    for (Vertex& v : mesh_.vertices) {
      const float length = glm::length(v.normal);
      v.normal = length > 0 ? v.normal / length : glm::vec3(mesh_.sides[v.side].normal);
    }
  }

  struct Entry {
    std::uint32_t vertex, element;
    float weight;
  };

  // Elements around a vertex count by the inverse of their centre's distance. A vertex put in on an edge that nobody shares
  // takes the values of the edge's ends, so that putting it in changes nothing that is seen.
  void makeWeights() {
    std::vector<Entry> entries;
    for (std::uint32_t p = 0; p < mesh_.pieces.size(); ++p) {
      const Surface& surface = mesh_.surfaces[piece_surface_[p]];
      const glm::dvec3 centre = mesh_.shapes[surface.elements.first + piece_element_[p]].centre;
      for (std::uint32_t k = ring_start_[p]; k < ring_start_[p + 1]; ++k) {
        const std::uint32_t v = localVertex(piece_surface_[p], ring_[k].point);
        if (!local_[v].corner() && !shared_[v]) continue;
        const double distance = glm::distance(centre, points_[local_[v].point]);
        for (std::uint32_t back = 0; back < 2; ++back) {
          const std::uint32_t side = surface.side[back];
          if (side == kNone) continue;
          entries.push_back({vertex_[2 * v + back], mesh_.sides[side].first_element + piece_element_[p],
                             static_cast<float>(1 / std::max(distance, 1e-30))});
        }
      }
    }
    std::vector<std::vector<Entry>> rows(mesh_.vertices.size());
    for (const Entry& e : entries) {
      auto& row = rows[e.vertex];
      if (std::none_of(row.begin(), row.end(), [&](const Entry& other) { return other.element == e.element; })) row.push_back(e);
    }
    interpolateAlongEdges(rows);
    for (auto& row : rows) {
      float sum = 0;
      for (const Entry& e : row) sum += e.weight;
      for (const Entry& e : row) {
        mesh_.vertex_from_elements.index.push_back(e.element);
        mesh_.vertex_from_elements.weight.push_back(e.weight / sum);
      }
      mesh_.vertex_from_elements.start.push_back(static_cast<std::uint32_t>(mesh_.vertex_from_elements.index.size()));
    }
  }

  void interpolateAlongEdges(std::vector<std::vector<Entry>>& rows) const {
    for (std::uint32_t s = 0; s < mesh_.surfaces.size(); ++s) {
      for (std::uint32_t v = local_start_[s]; v < local_start_[s + 1]; ++v) {
        if (local_[v].corner() || shared_[v]) continue;
        for (std::uint32_t back = 0; back < 2; ++back) {
          if (mesh_.surfaces[s].side[back] == kNone) continue;
          const std::uint32_t vertex = vertex_[2 * v + back];
          for (int end = 0; end < 2; ++end) {
            const auto& parent = rows[vertex_[2 * local_[v].parent[end] + back]];
            float sum = 0;
            for (const Entry& e : parent) sum += e.weight;
            const float share = end == 0 ? 1 - local_[v].along : local_[v].along;
            for (const Entry& e : parent) rows[vertex].push_back({vertex, e.element, share * e.weight / sum});
          }
        }
      }
    }
  }

  Mesh& mesh_;
  std::span<const SmoothPair> pairs_;
  double distance_;
  std::vector<std::uint32_t> piece_surface_, piece_element_;  // per piece
  std::vector<glm::dvec3> points_;
  std::vector<std::uint32_t> corner_point_;  // per piece corner
  std::vector<RingPoint> ring_;
  std::vector<std::uint32_t> ring_start_;    // per piece
  std::vector<LocalVertex> local_;           // per surface, sorted by point
  std::vector<std::uint32_t> local_start_;   // per surface
  std::vector<char> shared_;                 // per local vertex
  std::vector<std::uint32_t> group_;         // union-find over 2 v + back
  std::vector<std::uint32_t> vertex_;        // display vertex of 2 v + back
};

}  // namespace

void makeDisplay(Mesh& mesh, std::span<const SmoothPair> smooth_pairs, double weld_distance) {
  DisplayMaker(mesh, smooth_pairs, weld_distance).run();
}

}  // namespace unshot
