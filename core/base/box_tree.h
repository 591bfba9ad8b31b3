// A balanced tree over axis-parallel boxes: which of them overlap a given one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <numeric>
#include <vector>

#include "base/cancel.h"

namespace unshot {

struct Box {
  glm::dvec3 low, high;

  bool overlaps(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
};

class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes, const CancelToken& cancel = {})
      : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()), cancel);
  }

  /// Calls `found(index)` for each box that overlaps `query`.
  template <class F>
  void overlapping(const Box& query, F&& found) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, 64> stack{};
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t index = stack[--depth];
      const Node& node = nodes_[index];
      if (!node.box.overlaps(query)) continue;
      if (node.right != 0) {
        stack[depth++] = node.right;
        stack[depth++] = index + 1;
        continue;
      }
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        if (boxes_[order_[k]].overlaps(query)) found(order_[k]);
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, count;
    std::uint32_t right;  // second child; the first follows its parent; 0 in a leaf
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t count, const CancelToken& cancel) {
    cancel.check();
    Box box = boxes_[order_[first]];
    for (std::uint32_t k = first; k < first + count; ++k) {
      box.low = glm::min(box.low, boxes_[order_[k]].low);
      box.high = glm::max(box.high, boxes_[order_[k]].high);
    }
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({box, first, count, 0});
    if (count <= 8) return index;
    const glm::dvec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                     [&](std::uint32_t i, std::uint32_t j) {
                       return boxes_[i].low[axis] + boxes_[i].high[axis] <
                              boxes_[j].low[axis] + boxes_[j].high[axis];
                     });
    build(first, half, cancel);
    const std::uint32_t right = build(first + half, count - half, cancel);
    nodes_[index].right = right;
    return index;
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace unshot
