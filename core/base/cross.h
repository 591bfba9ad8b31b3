// The cross product in the plane.
#pragma once

#include <glm/vec2.hpp>

namespace unshot {

/// Twice the area of the triangle 0, a, b; positive where b lies counterclockwise of a.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace unshot
