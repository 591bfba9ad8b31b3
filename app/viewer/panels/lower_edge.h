// Where windows along the scene's lower edge find room beside or above each other.
#pragma once

#include <algorithm>
#include <vector>

namespace unshot {

/// What stands there so far [px].
class LowerEdge {
 public:
  /// The scene's part of the window that is free of names at its upper edge.
  LowerEdge(float scene_width, float top, float bottom)
      : scene_width_(scene_width), top_(top), bottom_(bottom) {}

  float sceneWidth() const { return scene_width_; }
  float top() const { return top_; }
  float bottom() const { return bottom_; }
  /// The y that a window from x = `left` to `right` has to keep to.
  float above(float left, float right) const {
    float y = bottom_;
    for (const Taken& one : taken_) {
      if (left < one.right && one.left < right) y = std::min(y, one.top);
    }
    return y;
  }
  /// A window stands there, with its gaps.
  void take(float left, float right, float top) { taken_.push_back({left, right, top}); }

 private:
  struct Taken {
    float left, right, top;
  };

  float scene_width_, top_, bottom_;
  std::vector<Taken> taken_;
};

}  // namespace unshot
