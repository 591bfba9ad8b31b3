#include "scene/polygon_plane.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace unshot {

PolygonPlane planeOf(std::span<const glm::dvec3> corners) {
  PolygonPlane plane;
  if (corners.size() < 3) return plane;
  glm::dvec3 low = corners[0], high = corners[0], twice_area{0.0}, mean{0.0};
  // Relative to the first corner: far from the origin the products would lose the digits that matter.
  for (std::size_t i = 1; i < corners.size(); ++i) {
    low = glm::min(low, corners[i]);
    high = glm::max(high, corners[i]);
    mean += (corners[i] - corners[0]) / static_cast<double>(corners.size());
    if (i + 1 < corners.size())
      twice_area += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  const glm::dvec3 extent = high - low;
  plane.size = std::max({extent.x, extent.y, extent.z});
  const glm::dvec3 largest = glm::max(glm::abs(low), glm::abs(high));
  const double length = glm::length(twice_area);
  plane.area = 0.5 * length;
  const double rounding =
      8 * std::numeric_limits<double>::epsilon() * std::max({largest.x, largest.y, largest.z});
  plane.flat = !(length > plane.size * (1e-12 * plane.size + rounding)) || !std::isfinite(length);
  if (plane.flat) return plane;
  plane.normal = twice_area / length;
  for (const glm::dvec3& corner : corners) {
    plane.thickness = std::max(plane.thickness, std::abs(glm::dot(plane.normal, corner - corners[0] - mean)));
  }
  return plane;
}

void projectOnto(const PolygonPlane& plane, std::span<const glm::dvec3> corners,
                 std::vector<glm::dvec2>& outline) {
  const glm::dvec3& n = plane.normal;
  const glm::dvec3 magnitude = glm::abs(n);
  glm::dvec3 helper{0.0};
  if (magnitude.x <= magnitude.y && magnitude.x <= magnitude.z) {
    helper.x = 1;
  } else if (magnitude.y <= magnitude.z) {
    helper.y = 1;
  } else {
    helper.z = 1;
  }
  const glm::dvec3 axis_u = glm::normalize(glm::cross(helper, n));
  const glm::dvec3 axis_v = glm::cross(n, axis_u);
  outline.clear();
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 d = corner - corners[0];
    outline.emplace_back(glm::dot(d, axis_u), glm::dot(d, axis_v));
  }
}

}  // namespace unshot
