// A scale that brings coordinates near 1, where the products that single precision makes of them neither
// overflow nor vanish.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace unshot {

/// The power of two that brings the largest coordinate to [0.5, 1), so that scaling rounds nothing; 1 where
/// there is no finite coordinate but 0. Kept so that both it and its inverse are normal numbers.
inline float unitScale(std::span<const glm::vec3> positions) {
  float largest = 0;
  for (const glm::vec3& p : positions) {
    const glm::vec3 size = glm::abs(p);
    largest = std::max({largest, size.x, size.y, size.z});
  }
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  return std::ldexp(1.0f, std::clamp(-(std::ilogb(largest) + 1), -125, 125));
}

}  // namespace unshot
