// The plane of a polygon in space.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace unshot {

/// Plane that fits a polygon's corners, by Newell's method: the sum of the cross products of successive
/// corners, half of whose length is the area. Good for any simple polygon, concave or with collinear corners.
struct PolygonPlane {
  glm::dvec3 normal{0.0};  ///< unit length; zero where the polygon has no area
  double area = 0;         ///< of the projection onto the plane
  double size = 0;         ///< largest extent of the corners along an axis
  double thickness = 0;    ///< largest distance of a corner from the plane through the corners' mean

  /// A polygon whose height over `size` is below rounding: 1e-12 of its size, and what the coordinates' own
  /// last bit makes.
  bool flat = true;
};

PolygonPlane planeOf(std::span<const glm::dvec3> corners);

/// The corners in axes of the plane, counter-clockwise, relative to the first corner.
void projectOnto(const PolygonPlane& plane, std::span<const glm::dvec3> corners,
                 std::vector<glm::dvec2>& outline);

}  // namespace unshot
