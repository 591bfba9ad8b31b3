// Linear RGB values.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace unshot {

/// Relative luminance of linear RGB (Rec. 709 primaries).
inline double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// Whether the three channels are the same.
inline bool isGrey(const glm::dvec3& c) { return c.x == c.y && c.y == c.z; }

/// Whether channel c is this factor times another one, to rounding.
inline bool isInProportion(const glm::dvec3& colour, int c, double factor, int other) {
  constexpr double kOfRounding = 1e-12;  // of decimal figures and some operations
  const double expected = factor * colour[other];
  return std::abs(colour[c] - expected) <= kOfRounding * std::abs(expected);
}

}  // namespace unshot
