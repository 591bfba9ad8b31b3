#include "session/element_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formfactor/polygon_factor.h"
#include "mesh/triangle_slope.h"

namespace unshot {
namespace {

// Polygons that look so small (radius over distance) are seen from nearly the same angle all over, and have
// their light in the middle.
constexpr double kNarrow = 0.25;
constexpr int kMostHalvings = 12;

}  // namespace

ElementSlopes::ElementSlopes(const Mesh& mesh, std::span<const glm::dvec3> light)
    : slopes_(mesh.element_count) {
  std::vector<double> area(mesh.element_count, 0.0);
  double sum = 0, whole = 0;
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const TriangleSlope triangle(mesh, t);
    const std::uint32_t e = mesh.triangle_element[t];
    Slope& slope = slopes_[e];
    slope.centre += triangle.area * triangle.middle;
    for (int c = 0; c < 3; ++c) slope.gradient[c] += triangle.gradient(light, c);
    area[e] += triangle.area;
    whole += triangle.area;
    const std::uint32_t* v = triangle.corner;
    const glm::dvec3 mean = (light[v[0]] + light[v[1]] + light[v[2]]) / 3.0;
    sum += triangle.area * std::max({mean.x, mean.y, mean.z});
  }
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    if (!(area[e] > 0)) continue;
    slopes_[e].centre /= area[e];
    for (glm::dvec3& gradient : slopes_[e].gradient) {
      gradient /= area[e];
      slopes_[e].steepest = std::max(slopes_[e].steepest, glm::length(gradient));
    }
  }
  negligible_ = kNegligible * (whole > 0 ? sum / whole : 0);
}

glm::dvec3 ElementSlopes::excess(std::uint32_t e, const glm::dvec3& moment) const {
  if (slopes_.empty()) return glm::dvec3(0.0);
  const auto& gradient = slopes_[e].gradient;
  return {glm::dot(gradient[0], moment), glm::dot(gradient[1], moment), glm::dot(gradient[2], moment)};
}

glm::dvec3 ElementSlopes::moment(const ReceiverView& view, std::uint32_t e, std::span<const glm::dvec3> ring,
                                 double factor, std::vector<glm::dvec3>& scratch) const {
  if (slopes_.empty()) return glm::dvec3(0.0);
  return moment(view, slopes_[e], ring, factor, 0, scratch);
}

// Halved across its longest sides until what is left is seen as small, or differs by little.
glm::dvec3 ElementSlopes::moment(const ReceiverView& view, const Slope& slope,
                                 std::span<const glm::dvec3> ring, double factor, int halvings,
                                 std::vector<glm::dvec3>& scratch) const {
  glm::dvec3 centre(0.0);
  for (const glm::dvec3& p : ring) centre += p / static_cast<double>(ring.size());
  double square = 0;
  for (const glm::dvec3& p : ring) square = std::max(square, glm::dot(p - centre, p - centre));
  const double radius = std::sqrt(square);
  if (factor * slope.steepest * radius <= negligible_ || halvings == kMostHalvings ||
      radius < kNarrow * glm::distance(centre, view.position))
    return factor * (centre - slope.centre);
  const auto part = [&](std::span<const glm::dvec3> of, double its) {
    return moment(view, slope, of, std::max(its, 0.0), halvings + 1, scratch);
  };
  const auto factorOf = [&](std::span<const glm::dvec3> of) {
    return pointToPolygonFactor(view.position, view.normal, of, scratch);
  };
  if (ring.size() > 4) {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 2; k < ring.size(); ++k) {
      const std::array<glm::dvec3, 3> triangle{ring[0], ring[k - 1], ring[k]};
      sum += part(triangle, factorOf(triangle));
    }
    return sum;
  }
  const auto length = [&](std::size_t k) { return glm::distance(ring[k], ring[(k + 1) % ring.size()]); };
  const auto middle = [&](std::size_t k) { return (ring[k] + ring[(k + 1) % ring.size()]) / 2.0; };
  if (ring.size() == 3) {
    std::size_t k = 0;
    for (const std::size_t other : {1u, 2u}) k = length(other) > length(k) ? other : k;
    const glm::dvec3& top = ring[(k + 2) % 3];
    const std::array<glm::dvec3, 3> one{top, ring[k], middle(k)}, two{top, middle(k), ring[(k + 1) % 3]};
    const double its = factorOf(one);
    return part(one, its) + part(two, factor - its);
  }
  const std::size_t k = length(0) + length(2) > length(1) + length(3) ? 0 : 1;
  const std::array<glm::dvec3, 4> one{ring[k], middle(k), middle((k + 2) % 4), ring[(k + 3) % 4]},
      two{middle(k), ring[k + 1], ring[(k + 2) % 4], middle((k + 2) % 4)};
  const double its = factorOf(one);
  return part(one, its) + part(two, factor - its);
}

}  // namespace unshot
