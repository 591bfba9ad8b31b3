#include "formfactor/polygon_factor.h"

#include <algorithm>
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

namespace {

constexpr double kFar = 4;  // radii
// Of the size of a quadrilateral: its opposite sides are alike.
constexpr double kAlike = 1e-9;

}  // namespace

FactorPolygon::FactorPolygon(std::vector<glm::dvec3> corners) : corners_(std::move(corners)) {
  const std::size_t n = corners_.size();
  for (const glm::dvec3& corner : corners_) centre_ += corner / static_cast<double>(n);
  glm::dvec3 area(0.0);
  for (std::size_t k = 0; k < n; ++k) {
    radius_ = std::max(radius_, glm::distance(corners_[k], centre_));
    area += glm::cross(corners_[k] - centre_, corners_[(k + 1) % n] - centre_) / 2.0;
  }
  const double size = glm::length(area);
  if (size <= 0) return;
  normal_ = area / size;
  area_ = size;
  parallelogram_ =
      n == 4 && glm::distance(corners_[1] - corners_[0], corners_[2] - corners_[3]) <= kAlike * radius_;
  if (parallelogram_) {
    const double step = 0.5 / std::numbers::sqrt3;
    const glm::dvec3 u = step * (corners_[1] - corners_[0]), v = step * (corners_[3] - corners_[0]);
    for (const glm::dvec3& at : {centre_ + u + v, centre_ + u - v, centre_ - u + v, centre_ - u - v})
      samples_.push_back({at, size / 4});
    return;
  }
  for (std::size_t k = 2; k < n; ++k) addTriangle(corners_[0], corners_[k - 1], corners_[k]);
}

void FactorPolygon::addTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double area = glm::length(glm::cross(b - a, c - a)) / 2;
  for (const glm::dvec3& at : {(4.0 * a + b + c) / 6.0, (a + 4.0 * b + c) / 6.0, (a + b + 4.0 * c) / 6.0})
    samples_.push_back({at, area / 3});
}

double FactorPolygon::quick(const glm::dvec3& point, const glm::dvec3& normal,
                            std::vector<glm::dvec3>& scratch) const {
  const glm::dvec3 to = centre_ - point;
  if (glm::dot(to, normal_) >= 0) return 0;
  if (glm::dot(to, to) <= kFar * kFar * radius_ * radius_ || glm::dot(to, normal) <= radius_)
    return exact(point, normal, scratch);
  return sampled(point, normal);
}

double FactorPolygon::rough(const glm::dvec3& point, const glm::dvec3& normal,
                            std::vector<glm::dvec3>& scratch) const {
  const glm::dvec3 to = centre_ - point;
  if (glm::dot(to, normal_) >= 0 || glm::dot(to, normal) <= -radius_) return 0;
  if (glm::dot(to, to) <= kFar * kFar * radius_ * radius_) return exact(point, normal, scratch);
  return sampled(point, normal);
}

double FactorPolygon::sampled(const glm::dvec3& point, const glm::dvec3& normal) const {
  double sum = 0;
  for (const Sample& sample : samples_) {
    const glm::dvec3 d = sample.at - point;
    const double square = glm::dot(d, d);
    sum += sample.area * std::max(glm::dot(d, normal), 0.0) / (square * square);
  }
  return sum * -glm::dot(centre_ - point, normal_) / std::numbers::pi;
}

}  // namespace unshot
