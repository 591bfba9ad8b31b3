#include "session/exact_look.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

// In a closed room all is seen, and nothing of the sky.
TEST(ExactLook, SeesAllOfAClosedRoom) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 0.5), {.elements = 100, .element_size = {}});
  const ExactLook exact(mesh);
  for (const glm::dvec3 at : {glm::dvec3(0.3, 0.3, 0.2), glm::dvec3(0.01, 0.99, 0.5), glm::dvec3(0.5)}) {
    const glm::dvec3 position(at.x, 0, at.z);
    const Gather look = exact.at(position - mesh.frame_origin, {0, 1, 0}, 0);
    double sum = 0;
    for (const Gather::Share& share : look.shares) {
      sum += static_cast<double>(share.weight);
      EXPECT_NE(mesh.sides[mesh.element_side[share.element]].normal, glm::dvec3(0, 1, 0));
    }
    EXPECT_NEAR(sum, 1, 3e-4);  // far tiles are taken at four points
    EXPECT_LT(look.sky, 3e-4);
  }
}

// What rays find, on each element, within their noise: 144 rays a look.
TEST(ExactLook, IsTheMeanOfLooksByRays) {
  const Mesh mesh = buildMesh(parallelSquares(0.5), {.elements = 8, .element_size = {}});
  const ExactLook exact(mesh);
  const Gatherer gatherer(mesh);
  for (std::uint32_t s = 0; s < mesh.sides.size(); ++s) {
    const Side& side = mesh.sides[s];
    const Surface& surface = mesh.surfaces[side.surface];
    const glm::dvec3 position = surface.point(surface.extent * glm::dvec2(0.3, 0.6));
    std::vector<double> by_rays(mesh.element_count, 0.0), by_factors(mesh.element_count, 0.0);
    const Gather look = exact.at(position, side.normal, 0);
    for (const Gather::Share& share : look.shares) by_factors[share.element] += share.weight;
    double sky = 0;
    constexpr int kLooks = 100;
    for (std::uint64_t k = 0; k < kLooks; ++k) {
      const Gather other = gatherer.look(position, side.normal, k);
      const double weight = 1.0 / (kLooks * static_cast<double>(other.rays.size()));
      for (const std::uint32_t e : other.rays) {
        if (e == kToSky) sky += weight;
        if (e < mesh.element_count) by_rays[e] += weight;
      }
    }
    // Five standard errors of 14,400 rays, were they not in strata.
    for (std::uint32_t e = 0; e < mesh.element_count; ++e)
      EXPECT_NEAR(by_factors[e], by_rays[e], 5 * std::sqrt(0.25 / 14'400)) << s << " " << e;
    EXPECT_NEAR(static_cast<double>(look.sky), sky, 5 * std::sqrt(0.25 / 14'400));
  }
}

}  // namespace
}  // namespace unshot
