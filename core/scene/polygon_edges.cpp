#include "scene/polygon_edges.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace unshot {
namespace {

/// For each position the lowest number of those at the same place.
std::vector<std::uint32_t> weldedPositions(const Scene& scene) {
  std::vector<std::uint32_t> order(scene.positions.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto key = [&](std::uint32_t k) {
    const glm::dvec3& p = scene.positions[k];
    return std::array<double, 3>{p.x, p.y, p.z};
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> welded(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && key(order[k - 1]) == key(order[k]);
    welded[order[k]] = same ? welded[order[k - 1]] : order[k];
  }
  return welded;
}

}  // namespace

std::vector<PolygonEdge> polygonEdges(const Scene& scene) {
  const std::vector<std::uint32_t> welded = weldedPositions(scene);
  std::vector<PolygonEdge> edges;
  edges.reserve(scene.corners.size());
  for (std::uint32_t p = 0; p < scene.polygons.size(); ++p) {
    const Polygon& polygon = scene.polygons[p];
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
      const std::uint32_t next = (k + 1) % polygon.corner_count;
      const std::uint32_t a = welded[scene.corners[polygon.first_corner + k].position];
      const std::uint32_t b = welded[scene.corners[polygon.first_corner + next].position];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), p, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const PolygonEdge& x, const PolygonEdge& y) {
    return std::tie(x.low, x.high, x.polygon) < std::tie(y.low, y.high, y.polygon);
  });
  return edges;
}

}  // namespace unshot
