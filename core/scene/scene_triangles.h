// The triangles of a scene: each polygon by ear clipping, as the scene's reader counts them.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace unshot {

/// Triangle t has the corners Scene::positions[corners[3 t + k]], counter-clockwise seen from the front of
/// its polygon, Scene::polygons[polygon[t]]. Triangles of no area are left out.
struct SceneTriangles {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> polygon;
  std::size_t size() const { return polygon.size(); }
};

SceneTriangles trianglesOf(const Scene& scene);

}  // namespace unshot
