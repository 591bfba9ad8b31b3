#include "report/scene_figures.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

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

double areaOf(const Scene& scene, const Polygon& polygon) {
  glm::dvec3 sum{0.0};
  const glm::dvec3& first = scene.position(polygon, 0);
  for (std::uint32_t k = 1; k + 1 < polygon.corner_count; ++k) {
    sum += glm::cross(scene.position(polygon, k) - first, scene.position(polygon, k + 1) - first);
  }
  return 0.5 * glm::length(sum);
}

std::size_t countOpenEdges(const Scene& scene) {
  const std::vector<std::uint32_t> welded = weldedPositions(scene);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Polygon& polygon : scene.polygons) {
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
      const std::uint32_t next = (k + 1) % polygon.corner_count;
      const std::uint32_t a = welded[scene.corners[polygon.first_corner + k].position];
      const std::uint32_t b = welded[scene.corners[polygon.first_corner + next].position];
      if (a != b) edges.push_back(std::minmax(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (std::size_t k = 0; k < edges.size();) {
    const std::size_t begin = k;
    while (k < edges.size() && edges[k] == edges[begin]) ++k;
    open += (k - begin) % 2;
  }
  return open;
}

}  // namespace

SceneFigures figuresOf(const Scene& scene) {
  SceneFigures figures;
  figures.faces = scene.face_count;
  figures.polygons = scene.polygons.size();
  figures.triangles = scene.triangle_count;
  figures.extent = scene.bounds_max - scene.bounds_min;
  figures.open_edges = countOpenEdges(scene);
  std::vector<bool> used(scene.materials.size());
  for (const Polygon& polygon : scene.polygons) {
    used[polygon.material] = true;
    const double area = areaOf(scene, polygon);
    figures.area += area;
    if (!scene.materials[polygon.material].emits()) continue;
    ++figures.emitters;
    figures.emitter_area += area;
  }
  figures.materials = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
  return figures;
}

}  // namespace unshot
