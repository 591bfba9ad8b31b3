// Linear RGB values.
#pragma once

#include <glm/vec3.hpp>

namespace unshot {

/// Relative luminance of linear RGB (Rec. 709 primaries).
inline double luminance(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// Whether the three channels are the same.
inline bool isGrey(const glm::dvec3& c) { return c.x == c.y && c.y == c.z; }

}  // namespace unshot
