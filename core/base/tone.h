// From exposed linear light to what a display shows: the curve of shaders/tone.glsl, for colours made without
// GL.
//
// Up to the knee a value is shown as it is; above it a shoulder tends to 1. The shoulder acts on the largest
// channel, so that the hue stays; far above the knee it acts on each channel, so that lamps go to white.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace unshot {

/// Linear values of the display, 0..1, from linear values where about 1 is white.
inline glm::dvec3 toneMap(const glm::dvec3& exposed) {
  constexpr double kKnee = 0.6;
  constexpr double kLargest = 1e4;
  const auto shoulder = [](double x) {
    const double over = x - kKnee;
    return over > 0 ? kKnee + (1 - kKnee) * over / (over + (1 - kKnee)) : x;
  };
  const glm::dvec3 c = glm::clamp(exposed, 0.0, kLargest);
  const double largest = std::max({c.x, c.y, c.z});
  if (largest <= kKnee) return c;
  const glm::dvec3 same_hue = c * (shoulder(largest) / largest);
  const glm::dvec3 each(shoulder(c.x), shoulder(c.y), shoulder(c.z));
  return glm::mix(same_hue, each, glm::smoothstep(0.0, 1.0, 1 - kKnee / largest));
}

}  // namespace unshot
