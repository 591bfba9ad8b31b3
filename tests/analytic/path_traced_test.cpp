// The path-traced reference against exact values and against an independent path tracer.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formfactor/polygon_factor.h"
#include "support/deviations.h"
#include "support/error_of.h"
#include "support/solving.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot {
namespace {

using namespace testing_support;

ReferenceOptions tracing(std::size_t points, std::uint64_t samples, std::uint64_t seed = 1) {
  ReferenceOptions options;
  options.points = points;
  options.seed = seed;
  options.relative_error = 0;
  options.max_samples = samples;
  return options;
}

// At the walls' own emission E = 1 - rho the radiosity is 1.
class FurnacePaths : public testing::TestWithParam<double> {};

TEST_P(FurnacePaths, AreOfOneRadiosityEverywhere) {
  const double rho = GetParam();
  const Reference reference =
      traceReference(furnaceScene(rho, 1 - rho), tracing(48, rho > 0.95 ? 256 : 1024));
  ASSERT_EQ(reference.points.size(), 48u);
  Deviations deviations;
  for (const ReferencePoint& p : reference.points) deviations.add(p.radiosity.x, 1, p.standard_error.x);
  measured("standard error", noiseOf(reference.points));
  measured("mean square of deviation / standard error", deviations.meanSquare());
  measured("worst of them", deviations.worst);
  EXPECT_LT(noiseOf(reference.points), 0.01);
  EXPECT_LT(deviations.worst, 4);
  EXPECT_GT(deviations.meanSquare(), 0.5);
  EXPECT_LT(deviations.meanSquare(), 1.7);
}

INSTANTIATE_TEST_SUITE_P(Reflectances, FurnacePaths, testing::Values(0.5, 0.9, 0.99), [](const auto& row) {
  return "Rho" + std::to_string(static_cast<int>(100 * row.param));
});

// A black emitter among walls that absorb nothing: the light has nowhere else to go, so B is its E
// everywhere.
TEST(PathTraced, GoesToTheEndWhereWallsAbsorbNothing) {
  std::array<Material, 6> materials;
  materials.fill({"wall", glm::dvec3(1.0), glm::dvec3(0.0)});
  const glm::dvec3 e(1, 0.5, 0.1);
  materials[1] = {"light", glm::dvec3(0.0), e};
  const Reference reference = traceReference(cubeScene(materials), tracing(32, 2048));
  Deviations deviations;
  for (const ReferencePoint& p : reference.points) {
    ASSERT_EQ(p.emission, glm::dvec3(0.0));
    deviations.add(p.radiosity.x, e.x, p.standard_error.x);
    EXPECT_NEAR(p.radiosity.y, 0.5 * p.radiosity.x, 1e-12);
  }
  measured("standard error", noiseOf(reference.points));
  measured("mean square of deviation / standard error", deviations.meanSquare());
  EXPECT_LT(noiseOf(reference.points), 0.02);
  EXPECT_LT(deviations.worst, 4);
  EXPECT_LT(deviations.meanSquare(), 2);
}

TEST(PathTraced, RefusesLightWithoutAnEnd) {
  const Error error = errorOf([] { traceReference(furnaceScene(1, 1), tracing(8, 64)); });
  EXPECT_EQ(error.kind(), ErrorKind::kInput);
  EXPECT_FALSE(error.advice().empty());
}

// Channels that differ by much go their own ways: each as if it were alone.
TEST(PathTraced, KeepsChannelsApart) {
  std::array<Material, 6> materials;
  const glm::dvec3 rho(0.9, 0.5, 0.01), e = glm::dvec3(1.0) - rho;
  materials.fill({"wall", rho, e});
  const Reference reference = traceReference(cubeScene(materials), tracing(32, 1024));
  Deviations deviations[3];
  for (const ReferencePoint& p : reference.points) {
    for (int c = 0; c < 3; ++c) deviations[c].add(p.radiosity[c], 1, p.standard_error[c]);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(deviations[c].worst, 4) << c;
    EXPECT_LT(deviations[c].meanSquare(), 2) << c;
  }
}

/// Points of the floor's upper side, from a thousandth of its edge from the line x = 0.
std::vector<ReferencePlace> placesOnFloor() {
  std::vector<ReferencePlace> places;
  for (const double x : {0.001, 0.01, 0.1, 0.3, 0.6, 0.9}) {
    for (const double z : {0.01, 0.2, 0.5, 0.95}) places.push_back({{x, 0, z}, {0, 1, 0}});
  }
  return places;
}

// Light that is reflected once, by a floor that sees nothing else: rho times the emitter's exact factor.
TEST(PathTraced, HasTheExactDirectLightOfRectangles) {
  for (const bool parallel : {true, false}) {
    const Scene scene = parallel ? parallelSquares(0.5) : perpendicularSquares(0.5);
    ReferenceOptions options = tracing(0, 4096);
    options.places = placesOnFloor();
    const Reference reference = traceReference(scene, options);
    const Polygon& light = scene.polygons[1];
    Deviations deviations;
    std::vector<glm::dvec3> corners, scratch;
    for (std::uint32_t k = 0; k < light.corner_count; ++k) {
      corners.push_back(scene.frame_origin + scene.position(light, k));
    }
    for (const ReferencePoint& p : reference.points) {
      const double factor = std::abs(pointToPolygonFactor(p.position, p.normal, corners, scratch));
      deviations.add(p.radiosity.x, 0.5 * factor, p.standard_error.x);
    }
    measured(parallel ? "parallel, standard error" : "perpendicular, standard error",
             noiseOf(reference.points));
    EXPECT_LT(deviations.worst, 4);
    EXPECT_LT(deviations.meanSquare(), 1.8);
    EXPECT_LT(noiseOf(reference.points), 0.01);
  }
}

// Differences to an independent path tracer, in units of both standard errors.
TEST(PathTraced, AgreesWithTheReferenceOfTheCornellBox) {
  const Truth truth = readReferencePoints(std::filesystem::path(UNSHOT_TEST_DATA) / "cornell_published.csv");
  ReferenceOptions options = tracing(0, 2048);
  options.places = placesOf(truth);
  const Reference reference = traceReference(publishedCornellBox(), options);
  ASSERT_EQ(reference.points.size(), truth.size());
  Deviations deviations;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const ReferencePoint& ours = reference.points[k];
    ASSERT_EQ(ours.emission, truth[k].emission) << k;
    ASSERT_EQ(ours.material, truth[k].material) << k;
    if (ours.emission != glm::dvec3(0.0)) continue;
    // The channels of a path are not independent: one speaks for all.
    deviations.add(ours.radiosity.x, truth[k].radiosity.x,
                   std::hypot(ours.standard_error.x, truth[k].standard_error.x));
  }
  measured("points", deviations.count);
  measured("mean square of deviation / standard error", deviations.meanSquare());
  measured("worst of them", deviations.worst);
  measured("bias in its own standard error", deviations.bias());
  EXPECT_GT(deviations.meanSquare(), 0.7);
  EXPECT_LT(deviations.meanSquare(), 1.3);
  EXPECT_LT(deviations.worst, 4.5);
  EXPECT_LT(std::abs(deviations.bias()), 3.5);
}

// Over seeds the estimates spread as their standard errors say.
TEST(PathTraced, HasHonestStandardErrors) {
  const Truth truth = readReferencePoints(std::filesystem::path(UNSHOT_TEST_DATA) / "cornell_published.csv");
  constexpr int kSeeds = 24;
  const Scene scene = publishedCornellBox();
  std::vector<double> sum(24, 0.0), square(24, 0.0), claimed(24, 0.0);
  for (int seed = 0; seed < kSeeds; ++seed) {
    ReferenceOptions options = tracing(0, 256, static_cast<std::uint64_t>(seed));
    for (const ReferencePlace& place : placesOf(truth)) {
      if (options.places.size() < sum.size()) options.places.push_back(place);
    }
    const Reference reference = traceReference(scene, options);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double b = reference.points[k].reflected().x / truth[k].radiosity.x;
      const double se = reference.points[k].standard_error.x / truth[k].radiosity.x;
      sum[k] += b;
      square[k] += b * b;
      claimed[k] += se * se / kSeeds;
    }
  }
  double spread = 0, said = 0;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    spread += (square[k] - sum[k] * sum[k] / kSeeds) / (kSeeds - 1) / claimed[k];
    said += 1;
  }
  measured("variance over seeds / claimed", spread / said);
  EXPECT_NEAR(spread / said, 1, 0.25);
}

}  // namespace
}  // namespace unshot
