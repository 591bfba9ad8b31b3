#include "formfactor/polygon_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace unshot {

namespace {

// atan(x) / x as a polynomial in x^2, lowest power first, for |x| <= tan(pi / 8): the Chebyshev fit of
// degree 10, which is off by 4e-17 at most.
constexpr std::array<double, 11> kArcTangent{
    0.99999999999999997,  -0.33333333333328439,  0.19999999998855110,  -0.14285714180976467,
    0.11111106180455945,  -0.090907730748084138, 0.076899534963068578, -0.066402339304294086,
    0.056883492268090105, -0.043480522157164625, 0.021135373157693245};

// By Estrin's scheme, whose terms do not wait for each other as Horner's do.
inline double arcTangentOver(double y) {
  constexpr auto& c = kArcTangent;
  const double y2 = y * y, y4 = y2 * y2;
  const double low = (c[0] + c[1] * y) + (c[2] + c[3] * y) * y2,
               middle = (c[4] + c[5] * y) + (c[6] + c[7] * y) * y2, high = (c[8] + c[9] * y) + c[10] * y2;
  return low + (middle + high * y4) * y4;
}
constexpr double kEighth = std::numbers::sqrt2 - 1;  // tan(pi / 8)

// A ring of corners around the point that is the origin, coordinate by coordinate, so that edges are worked
// on side by side; the first corner once more at the end.
template <std::size_t kMost>
struct Ring {
  std::array<double, kMost + 1> x, y, z, length;

  void set(std::size_t k, const glm::dvec3& at) {
    x[k] = at.x;
    y[k] = at.y;
    z[k] = at.z;
    length[k] = glm::length(at);
  }
};

// Sum over its n edges, all of it above the horizon. The angle of an edge between a and b is twice the arc
// tangent of |a x b| / (|a| |b| + a . b): no two numbers that are alike are subtracted, and a polynomial is
// several times sooner than atan2.
template <std::size_t kMost>
double factorOf(const Ring<kMost>& ring, const std::size_t n, const glm::dvec3& normal) {
  std::array<double, kMost> angle, along;
  for (std::size_t k = 0; k < n; ++k) {
    const double cx = ring.y[k] * ring.z[k + 1] - ring.z[k] * ring.y[k + 1],
                 cy = ring.z[k] * ring.x[k + 1] - ring.x[k] * ring.z[k + 1],
                 cz = ring.x[k] * ring.y[k + 1] - ring.y[k] * ring.x[k + 1];
    const double cross = std::sqrt(cx * cx + cy * cy + cz * cz);
    const double dot = ring.x[k] * ring.x[k + 1] + ring.y[k] * ring.y[k + 1] + ring.z[k] * ring.z[k + 1];
    const double nearer = ring.length[k] * ring.length[k + 1] + std::abs(dot);  // less than a right angle
    const bool wide = cross > kEighth * nearer;  // atan(x) = pi / 4 + atan((x - 1) / (x + 1))
    const double x = (wide ? cross - nearer : cross) / (wide ? cross + nearer : nearer);
    const double half = arcTangentOver(x * x) * x + (wide ? std::numbers::pi / 4 : 0.0);
    angle[k] = dot < 0 ? std::numbers::pi - 2 * half : 2 * half;
    along[k] = (normal.x * cx + normal.y * cy + normal.z * cz) / (cross > 0 ? cross : 1.0);
  }
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += angle[k] * along[k];
  return -sum / (2 * std::numbers::pi);
}

// Of a corner's distance: so far below the horizon it is on it.
constexpr double kRounding = 1e-14;

}  // namespace

double pointToPolygonFactor(const glm::dvec3& point, const glm::dvec3& normal,
                            std::span<const glm::dvec3> corners, std::vector<glm::dvec3>& scratch) {
  const std::size_t n = corners.size();
  if (n == 4) {  // nearly always, and mostly all of it counts
    Ring<4> ring;
    bool above = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec3 to = corners[k] - point;
      ring.set(k, to);
      above = above && glm::dot(normal, to) >= -kRounding * ring.length[k];
    }
    ring.x[4] = ring.x[0];
    ring.y[4] = ring.y[0];
    ring.z[4] = ring.z[0];
    ring.length[4] = ring.length[0];
    if (above) return factorOf(ring, 4, normal);
  }
  scratch.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const glm::dvec3 a = corners[k] - point, b = corners[(k + 1) % n] - point;
    const double ha = glm::dot(normal, a), hb = glm::dot(normal, b);
    if (ha >= 0) scratch.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) scratch.push_back(a + ha / (ha - hb) * (b - a));
  }
  if (scratch.size() < 3) return 0;
  if (scratch.size() <= 5) {
    Ring<5> ring;
    for (std::size_t k = 0; k <= scratch.size(); ++k) ring.set(k, scratch[k < scratch.size() ? k : 0]);
    return factorOf(ring, scratch.size(), normal);
  }
  double sum = 0;
  Ring<1> edge;
  for (std::size_t k = 0; k < scratch.size(); ++k) {
    edge.set(0, scratch[k]);
    edge.set(1, scratch[(k + 1) % scratch.size()]);
    sum += factorOf(edge, 1, normal);
  }
  return sum;
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
