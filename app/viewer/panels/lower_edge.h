// Where windows along the scene's lower edge find room beside or above each other.
#pragma once

#include <algorithm>

namespace unshot {

/// What stands there so far [px].
struct LowerEdge {
  float left = 0, right = 0;  ///< y of the top of what stands at the left and at the right
  float right_width = 0;      ///< of what stands at the right, with the gap beside it
  float scene_width = 0;

  /// The y that a window at the left, `width` wide with its gaps, has to keep to.
  float aboveLeft(float width) const {
    return width + right_width <= scene_width ? left : std::min(left, right);
  }
};

}  // namespace unshot
