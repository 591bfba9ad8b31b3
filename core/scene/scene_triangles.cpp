#include "scene/scene_triangles.h"

#include <glm/geometric.hpp>

#include "scene/polygon_plane.h"
#include "scene/triangulate.h"

namespace unshot {

SceneTriangles trianglesOf(const Scene& scene) {
  SceneTriangles out;
  std::vector<glm::dvec3> corners;
  std::vector<glm::dvec2> outline;
  for (std::uint32_t p = 0; p < scene.polygons.size(); ++p) {
    const Polygon& polygon = scene.polygons[p];
    corners.clear();
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k) corners.push_back(scene.position(polygon, k));
    const PolygonPlane plane = planeOf(corners);
    if (plane.flat) continue;
    projectOnto(plane, corners, outline);
    for (const auto& triangle : triangulate(outline)) {
      const glm::dvec3 cross = glm::cross(corners[triangle[1]] - corners[triangle[0]],
                                          corners[triangle[2]] - corners[triangle[0]]);
      if (!(glm::dot(cross, plane.normal) > 0)) continue;
      for (const std::uint32_t k : triangle) {
        out.corners.push_back(scene.corners[polygon.first_corner + k].position);
      }
      out.polygon.push_back(p);
    }
  }
  return out;
}

}  // namespace unshot
