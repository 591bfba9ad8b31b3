// Directions as diffuse light takes them.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace unshot {

/// Cosine-distributed about the normal `n` (of unit length) for `u`, `v` uniform in [0, 1); of unit length.
/// Axes: T. Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
inline glm::dvec3 cosineDirection(const glm::dvec3& n, double u, double v) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  const glm::dvec3 x(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), y(b, sign + n.y * n.y * a, -n.y);
  const double radius = std::sqrt(u), angle = 2 * std::numbers::pi * v;
  const glm::dvec3 d = radius * std::cos(angle) * x + radius * std::sin(angle) * y + std::sqrt(1 - u) * n;
  return glm::normalize(d);
}

}  // namespace unshot
