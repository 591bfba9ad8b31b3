#include "base/point_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>

namespace unshot {
namespace {

constexpr std::uint32_t kLeafSize = 8;

// Whether the segment from a on meets the box (slab test over t in [0, 1]). `inverse`: 1 / (b - a), infinite
// along axes that it does not go along.
bool segmentMeetsBox(const glm::dvec3& a, const glm::dvec3& inverse, const glm::dvec3& low,
                     const glm::dvec3& high) {
  double t0 = 0, t1 = 1;
  for (int k = 0; k < 3; ++k) {
    if (std::isinf(inverse[k])) {
      if (a[k] < low[k] || a[k] > high[k]) return false;
      continue;
    }
    double enter = (low[k] - a[k]) * inverse[k], leave = (high[k] - a[k]) * inverse[k];
    if (enter > leave) std::swap(enter, leave);
    t0 = std::max(t0, enter);
    t1 = std::min(t1, leave);
    if (t0 > t1) return false;
  }
  return true;
}

double squaredDistanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = b - a;
  const double length2 = glm::dot(d, d);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 offset = p - (a + t * d);
  return glm::dot(offset, offset);
}

}  // namespace

PointTree::PointTree(std::span<const glm::dvec3> points, const CancelToken& cancel)
    : points_(points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!points.empty()) {
    boxes_.reserve(2 * points.size() / kLeafSize + 2);
    build(0, static_cast<std::uint32_t>(points.size()), cancel);
  }
}

std::uint32_t PointTree::build(std::uint32_t first, std::uint32_t count, const CancelToken& cancel) {
  cancel.check();
  Box box{points_[order_[first]], points_[order_[first]], first, count, 0};
  for (std::uint32_t k = first; k < first + count; ++k) {
    box.low = glm::min(box.low, points_[order_[k]]);
    box.high = glm::max(box.high, points_[order_[k]]);
  }
  const auto index = static_cast<std::uint32_t>(boxes_.size());
  boxes_.push_back(box);
  if (count <= kLeafSize) return index;
  const glm::dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::uint32_t i, std::uint32_t j) { return points_[i][axis] < points_[j][axis]; });
  build(first, half, cancel);
  const std::uint32_t right = build(first + half, count - half, cancel);
  boxes_[index].right = right;
  return index;
}

// Goes through the tree, into boxes that `meets` lets pass, and hands their points to `visit` until it
// returns true.
template <class Meets, class Visit>
bool PointTree::search(Meets&& meets, Visit&& visit) const {
  if (boxes_.empty()) return false;
  std::array<std::uint32_t, 64> stack{};
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Box& box = boxes_[index];
    if (!meets(box)) continue;
    if (box.right != 0) {
      stack[depth++] = box.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t k = box.first; k < box.first + box.count; ++k) {
      if (visit(order_[k])) return true;
    }
  }
  return false;
}

void PointTree::nearSegment(const glm::dvec3& a, const glm::dvec3& b, double distance,
                            const std::function<void(std::uint32_t)>& found) const {
  const glm::dvec3 low = glm::min(a, b) - distance, high = glm::max(a, b) + distance;
  if (a == b) {
    search(
        [&](const Box& box) {
          const glm::dvec3 off = a - glm::clamp(a, box.low, box.high);
          return glm::dot(off, off) <= distance * distance;
        },
        [&](std::uint32_t k) {
          const glm::dvec3 off = points_[k] - a;
          if (glm::dot(off, off) <= distance * distance) found(k);
          return false;
        });
    return;
  }
  const glm::dvec3 inverse = 1.0 / (b - a);
  search(
      [&](const Box& box) {
        return glm::all(glm::lessThanEqual(box.low, high)) && glm::all(glm::lessThanEqual(low, box.high)) &&
               segmentMeetsBox(a, inverse, box.low - distance, box.high + distance);
      },
      [&](std::uint32_t k) {
        if (squaredDistanceToSegment(points_[k], a, b) <= distance * distance) found(k);
        return false;
      });
}

bool PointTree::anyInFront(std::span<const HalfSpace> planes) const {
  return search(
      [&](const Box& box) {
        return std::all_of(planes.begin(), planes.end(), [&](const HalfSpace& in) {
          const glm::dvec3 corner{in.normal.x > 0 ? box.high.x : box.low.x,
                                  in.normal.y > 0 ? box.high.y : box.low.y,
                                  in.normal.z > 0 ? box.high.z : box.low.z};
          return glm::dot(in.normal, corner) > in.offset;
        });
      },
      [&](std::uint32_t k) {
        return std::all_of(planes.begin(), planes.end(),
                           [&](const HalfSpace& in) { return glm::dot(in.normal, points_[k]) > in.offset; });
      });
}

}  // namespace unshot
