// Joins what touches: positions that coincide become one, and a vertex that lies on another polygon's edge
// becomes a corner of that polygon, so that what meets in space meets in vertices and no crack opens between
// rasterised polygons.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "scene/scene.h"

namespace unshot {

/// Positions closer than this [m] are one. A millionth of the scene's diagonal: above the rounding of
/// six-digit text.
double weldDistance(const Scene& scene);

struct WeldedScene {
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> from_scene;  ///< welded index of each of the scene's positions
  std::vector<std::uint32_t> start{
      0};  ///< corners of polygon p: corners[start[p]] .. corners[start[p + 1] - 1]
  std::vector<std::uint32_t>
      corners;  ///< welded positions; no two neighbours alike; empty where a polygon collapsed
  std::span<const std::uint32_t> outline(std::size_t polygon) const {
    return {corners.data() + start[polygon], corners.data() + start[polygon + 1]};
  }
};

/// Representative of each point: the first one within `distance` (chains are not followed). One value per
/// point.
std::vector<std::uint32_t> mergePoints(std::span<const glm::dvec3> points, double distance,
                                       const CancelToken& cancel = {});

WeldedScene weld(const Scene& scene, const CancelToken& cancel = {});

}  // namespace unshot
