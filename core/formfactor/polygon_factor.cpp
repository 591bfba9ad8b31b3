#include "formfactor/polygon_factor.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace unshot {

double pointToPolygonFactor(const glm::dvec3& point, const glm::dvec3& normal,
                            std::span<const glm::dvec3> corners, std::vector<glm::dvec3>& scratch) {
  scratch.clear();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const glm::dvec3 a = corners[k] - point, b = corners[(k + 1) % corners.size()] - point;
    const double ha = glm::dot(normal, a), hb = glm::dot(normal, b);
    if (ha >= 0) scratch.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) scratch.push_back(a + ha / (ha - hb) * (b - a));
  }
  if (scratch.size() < 3) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < scratch.size(); ++k) {
    const glm::dvec3& a = scratch[k];
    const glm::dvec3& b = scratch[(k + 1) % scratch.size()];
    const glm::dvec3 cross = glm::cross(a, b);
    const double length = glm::length(cross);
    if (length <= 0) continue;
    sum += std::atan2(length, glm::dot(a, b)) * glm::dot(normal, cross) / length;
  }
  return -sum / (2 * std::numbers::pi);
}

}  // namespace unshot
