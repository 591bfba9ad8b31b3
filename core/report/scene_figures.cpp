#include "report/scene_figures.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "scene/polygon_edges.h"

namespace unshot {
namespace {

double areaOf(const Scene& scene, const Polygon& polygon) {
  glm::dvec3 sum{0.0};
  const glm::dvec3& first = scene.position(polygon, 0);
  for (std::uint32_t k = 1; k + 1 < polygon.corner_count; ++k) {
    sum += glm::cross(scene.position(polygon, k) - first, scene.position(polygon, k + 1) - first);
  }
  return 0.5 * glm::length(sum);
}

std::size_t countOpenEdges(const Scene& scene) {
  std::size_t open = 0;
  forEachEdge(polygonEdges(scene), [&](std::span<const PolygonEdge> uses) { open += uses.size() % 2; });
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
