// A balanced tree of bounding boxes over points: which points lie near a segment, whether any lies in front
// of a plane.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/cancel.h"

namespace unshot {

class PointTree {
 public:
  /// Keeps a reference to `points`, which must outlive the tree.
  explicit PointTree(std::span<const glm::dvec3> points, const CancelToken& cancel = {});

  /// Calls `found(index)` for each point within `distance` of the segment a-b, in no particular order.
  void nearSegment(const glm::dvec3& a, const glm::dvec3& b, double distance,
                   const std::function<void(std::uint32_t)>& found) const;

  /// The half-space in front of a plane: dot(normal, p) > offset.
  struct HalfSpace {
    glm::dvec3 normal;
    double offset;
  };
  /// Whether some point lies in all of these.
  bool anyInFront(std::span<const HalfSpace> planes) const;
  bool anyInFront(const HalfSpace& plane) const { return anyInFront(std::span(&plane, 1)); }

 private:
  struct Box {
    glm::dvec3 low, high;
    std::uint32_t first, count;  // points, in order_
    std::uint32_t right;         // second child; the first follows its parent; 0 in a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count, const CancelToken& cancel);
  template <class Meets, class Visit>
  bool search(Meets&& meets, Visit&& visit) const;

  std::span<const glm::dvec3> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;
};

}  // namespace unshot
