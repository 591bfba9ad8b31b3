#include "mesh/weld.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/cancel.h"
#include "base/point_tree.h"

namespace unshot {
namespace {

constexpr double kMergedShare = 0.3;  // of the time that a scene takes

// Points hashed by cells of twice the merging distance, so that what lies within the distance of a point is
// in the cells that its box touches: mostly one, at most eight.
class PointHash {
 public:
  PointHash(std::span<const glm::dvec3> points, double distance)
      : points_(points),
        distance_(distance),
        size_(std::max(2 * distance, 1e-300)),
        next_(points.size(), kNone) {
    std::size_t slots = 16;
    while (slots < 2 * points.size()) slots *= 2;
    head_.assign(slots, kNone);
  }

  // An earlier point within the distance of point k, else k, which is then stored.
  std::uint32_t findOrAdd(std::uint32_t k) {
    const glm::dvec3& p = points_[k];
    const glm::dvec3 low = glm::floor((p - distance_) / size_), high = glm::floor((p + distance_) / size_);
    for (double x = low.x; x <= high.x; ++x) {
      for (double y = low.y; y <= high.y; ++y) {
        for (double z = low.z; z <= high.z; ++z) {
          for (std::uint32_t other = head_[slot({x, y, z})]; other != kNone; other = next_[other]) {
            if (glm::distance(points_[other], p) <= distance_) return other;
          }
        }
      }
    }
    std::uint32_t& head = head_[slot(glm::floor(p / size_))];
    next_[k] = head;
    head = k;
    return k;
  }

 private:
  std::size_t slot(const glm::dvec3& cell) const {
    std::uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis) {
      h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis]))) *
          0x9e3779b97f4a7c15ull;
    }
    return static_cast<std::size_t>(h >> 20) & (head_.size() - 1);
  }

  std::span<const glm::dvec3> points_;
  double distance_, size_;
  std::vector<std::uint32_t> head_, next_;
};

// The corners of one edge from a to b with the vertices that lie on it between, in order; without b.
void appendEdge(const std::vector<glm::dvec3>& positions, const PointTree& tree, std::uint32_t a,
                std::uint32_t b, double distance, std::vector<std::uint32_t>& out) {
  out.push_back(a);
  const glm::dvec3 pa = positions[a], d = positions[b] - pa;
  const double length = glm::length(d);
  std::vector<std::pair<double, std::uint32_t>> between;
  tree.nearSegment(pa, positions[b], distance, [&](std::uint32_t v) {
    if (v == a || v == b) return;
    const double along = glm::dot(positions[v] - pa, d) / length;
    if (along > distance && along < length - distance) between.emplace_back(along, v);
  });
  std::sort(between.begin(), between.end());
  for (const auto& [along, v] : between) out.push_back(v);
}

}  // namespace

double weldDistance(const Scene& scene) { return 1e-6 * glm::length(scene.bounds_max - scene.bounds_min); }

std::vector<std::uint32_t> mergePoints(std::span<const glm::dvec3> points, double distance,
                                       const CancelToken& cancel) {
  std::vector<std::uint32_t> representative(points.size());
  PointHash hash(points, distance);
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    cancel.check();
    if (k % kToldEvery == 0) cancel.report(static_cast<double>(k) / static_cast<double>(points.size()));
    representative[k] = hash.findOrAdd(k);
  }
  return representative;
}

WeldedScene weld(const Scene& scene, const CancelToken& cancel) {
  const double distance = weldDistance(scene);
  WeldedScene out;
  const std::vector<std::uint32_t> representative =
      mergePoints(scene.positions, distance, cancel.part(0, kMergedShare));
  out.from_scene.resize(scene.positions.size());
  for (std::uint32_t k = 0; k < representative.size(); ++k) {
    if (representative[k] == k) {
      out.from_scene[k] = static_cast<std::uint32_t>(out.positions.size());
      out.positions.push_back(scene.positions[k]);
    } else {
      out.from_scene[k] = out.from_scene[representative[k]];
    }
  }

  const PointTree tree(out.positions, cancel);
  out.start.reserve(scene.polygons.size() + 1);
  std::vector<std::uint32_t> ring;
  const CancelToken rings = cancel.part(kMergedShare, 1);
  for (const Polygon& polygon : scene.polygons) {
    cancel.check();
    if (out.start.size() % kToldEvery == 0)
      rings.report(static_cast<double>(out.start.size()) / static_cast<double>(scene.polygons.size()));
    ring.clear();
    for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
      const std::uint32_t v = out.from_scene[scene.corners[polygon.first_corner + k].position];
      if (ring.empty() || ring.back() != v) ring.push_back(v);
    }
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() >= 3) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        appendEdge(out.positions, tree, ring[k], ring[(k + 1) % ring.size()], distance, out.corners);
      }
    }
    out.start.push_back(static_cast<std::uint32_t>(out.corners.size()));
  }
  return out;
}

}  // namespace unshot
