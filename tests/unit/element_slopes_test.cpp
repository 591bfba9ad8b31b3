// What a view receives of light that changes along an element, against a sum over small parts of it.
#include "session/element_slopes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "formfactor/polygon_factor.h"
#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

// The wall x = -1/2 of a unit cube about the origin, whose light grows from 0 at the floor to 2 at the
// ceiling, as a point of the floor sees it.
class Wall {
 public:
  Wall() : mesh_(buildMesh(furnaceScene(0.5, 1), {6, {}, false})) {
    for (const Vertex& vertex : mesh_.vertices)
      light_.push_back(glm::dvec3(1, 0.5, 0) * (1 + 2 * double{vertex.position.y}));
    slopes_ = ElementSlopes(mesh_, light_);
    for (std::uint32_t e = 0; e < mesh_.element_count; ++e) {
      const Side& side = mesh_.sides[mesh_.element_side[e]];
      if (side.normal.x > 0.9 && mesh_.surfaces[side.surface].origin.x < 0) element_ = e;
    }
  }

  // Its irradiance on a floor `away` from the wall, by the mean and the slope, and by small parts.
  std::array<double, 2> irradiance(double away, std::size_t corners) {
    const ReceiverView view{{away - 0.5, -0.5, 0.05}, {0, 1, 0}, 1, 0, 0};
    // Counter-clockwise as seen from inside.
    std::vector<glm::dvec3> ring{{-0.5, -0.5, 0.5}, {-0.5, -0.5, -0.5}, {-0.5, 0.5, -0.5}, {-0.5, 0.5, 0.5}};
    if (corners == 3) ring.pop_back();
    if (corners == 5) ring.insert(ring.begin() + 1, {-0.5, -0.5, 0});
    const double factor = pointToPolygonFactor(view.position, view.normal, ring, scratch_);
    // The triangle has less than the wall's mean light, the slope the rest.
    const double found =
        factor * 1.0 + slopes_.excess(element_, slopes_.moment(view, element_, ring, factor, scratch_)).x;
    double sum = 0;
    constexpr int n = 600;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        // Finer towards the edge that the point is near to.
        const auto at = [&](int k) { return std::pow(k / double{n}, 3) - 0.5; };
        const double y0 = at(i), y1 = at(i + 1), z0 = j / double{n} - 0.5, z1 = (j + 1) / double{n} - 0.5;
        const glm::dvec3 p(-0.5, (y0 + y1) / 2, (z0 + z1) / 2), to = p - view.position;
        // The triangle is what lies below the line from the one corner to the other.
        if (corners == 3 && p.y + p.z > 0) continue;
        const double square = glm::dot(to, to);
        sum += (1 + 2 * p.y) * to.y * away / (square * square) * (y1 - y0) * (z1 - z0) / std::numbers::pi;
      }
    }
    return {found, sum};
  }

 private:
  Mesh mesh_;
  std::vector<glm::dvec3> light_;
  ElementSlopes slopes_;
  std::uint32_t element_ = 0;
  std::vector<glm::dvec3> scratch_;
};

// With the mean alone the point beside the edge would have 0.5, many times too much.
TEST(ElementSlopes, AreWhatAPointBesideAnEdgeSees) {
  Wall wall;
  for (const double away : {0.025, 0.1, 0.35}) {
    for (const std::size_t corners : {4u, 3u, 5u}) {
      const auto [found, summed] = wall.irradiance(away, corners);
      // Half a percent of the mean light of 1, and what the small parts leave.
      EXPECT_NEAR(found, summed, 0.008) << away << " " << corners;
    }
  }
  const auto [found, summed] = wall.irradiance(0.025, 4);
  measured("irradiance beside the edge", found);
  EXPECT_LT(summed, 0.1);
}

TEST(ElementSlopes, AreNothingWhereLightIsEven) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 1), {6, {}, false});
  const std::vector<glm::dvec3> even(mesh.vertices.size(), glm::dvec3(3.0));
  const ElementSlopes slopes(mesh, even), none;
  std::vector<glm::dvec3> scratch;
  const std::vector<glm::dvec3> ring{
      {-0.5, -0.5, 0.5}, {-0.5, -0.5, -0.5}, {-0.5, 0.5, -0.5}, {-0.5, 0.5, 0.5}};
  const ReceiverView view{{-0.4, -0.5, 0}, {0, 1, 0}, 1, 0, 0};
  for (std::uint32_t e = 0; e < mesh.element_count; ++e)
    EXPECT_LT(glm::length(slopes.excess(e, slopes.moment(view, e, ring, 0.4, scratch))), 1e-9);
  EXPECT_EQ(none.excess(0, none.moment(view, 0, ring, 0.4, scratch)), glm::dvec3(0.0));
}

}  // namespace
}  // namespace unshot
