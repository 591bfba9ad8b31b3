// The Cornell box against path-traced values.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "scene/analytic_scenes.h"
#include "support/solving.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot {
namespace {

using namespace testing_support;

// The aim of the program on this scene, 5 %, and a tighter one that holds; 1.3 % are measured, of which about
// 0.3 % are the reference's own noise.
constexpr double kAsked = 0.05, kHeld = 0.03;

Truth truth(const std::string& bounces = {}) {
  return readReferencePoints(std::filesystem::path(UNSHOT_TEST_DATA) /
                             ("cornell_published" + bounces + ".csv"));
}

TEST(CornellBox, RefusesAReferenceThatLacksBounces) {
  const Truth full = truth();
  EXPECT_TRUE(isFaithful(full, valuesOf(full), kHeld));
  for (const std::string bounces : {"_direct", "_2bounce"}) {
    const Truth part = truth(bounces);
    ASSERT_EQ(part.size(), full.size());
    for (std::size_t k = 0; k < full.size(); ++k) ASSERT_EQ(part[k].position, full[k].position);
    measured(bounces, reflectedError(full, valuesOf(part)));
    EXPECT_FALSE(isFaithful(full, valuesOf(part), kAsked)) << bounces;
  }
}

// Mean over the points of the blocks' sides that face red (+x) or green (-x).
glm::dvec3 meanOfBlockSide(const Truth& points, const Values& values, bool red) {
  glm::dvec3 sum(0.0);
  int count = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const glm::dvec3 &p = points[k].position, n = points[k].normal;
    if (points[k].material != "white" || p.y < 1 || p.y > 331 || p.z > 558) continue;
    if ((red ? n.x : -n.x) < 0.5) continue;
    sum += values[k].value_or(glm::dvec3(0.0));
    ++count;
  }
  EXPECT_GE(count, 5);
  return sum / static_cast<double>(std::max(count, 1));
}

TEST(CornellBox, HasTheReflectedLightAndColourBleedingOfTheReference) {
  const auto solve = solved(publishedCornellBox(), optionsOf("hemicube", 10'000, 0.002));
  const Truth points = truth();
  const std::vector<Probe> probes = probesOf(points);
  const Values values = answerProbes(solve->snapshot(), probes, false);
  std::size_t without = 0;
  for (const auto& value : values) without += !value;
  EXPECT_LE(without, points.size() / 100);
  const double error = reflectedError(points, values);
  measured("nRMSE of reflected light", error);
  measured("hemicubes", static_cast<double>(solve->drawn()));
  EXPECT_TRUE(isFaithful(points, values, kAsked));
  EXPECT_TRUE(isFaithful(points, values, kHeld));

  const Values exact = valuesOf(points);
  glm::dvec3 mean[2];
  for (const bool red : {false, true}) {
    mean[red] = meanOfBlockSide(points, values, red);
    const glm::dvec3 expected = meanOfBlockSide(points, exact, red);
    const std::string side = red ? "facing red" : "facing green";
    measured(side + ", R/G", mean[red].x / mean[red].y);
    measured(side + ", R/B", mean[red].x / mean[red].z);
    EXPECT_NEAR(mean[red].x / mean[red].y, expected.x / expected.y, 0.1 * expected.x / expected.y) << side;
    EXPECT_NEAR(mean[red].x / mean[red].z, expected.x / expected.z, 0.1 * expected.x / expected.z) << side;
  }
  EXPECT_GT(mean[1].x / mean[1].y, 1.1 * mean[0].x / mean[0].y) << "the red wall colours what faces it";
}

// Rays at the vertices of a quarter of the elements: 1.7 % are measured.
TEST(CornellBox, HasTheReflectedLightOfTheReferenceByRaysOnACoarserMesh) {
  const auto solve = solved(publishedCornellBox(), optionsOf("rays", 2'500, 0.002));
  const Truth points = truth();
  const double error = reflectedError(points, answerProbes(solve->snapshot(), probesOf(points), false));
  measured("nRMSE of reflected light", error);
  EXPECT_LT(error, 0.025);
}

struct Fineness {
  const char* name;
  const char* form_factors;
  std::optional<std::uint64_t> elements;  // else the mesh follows the light
  double error;
};

// The program's own estimate of the whole error against path-traced truth at other points: the error found
// there lies in its interval.
class CornellEstimates : public testing::TestWithParam<Fineness> {};

TEST_P(CornellEstimates, HoldTheErrorThatTheReferenceShows) {
  SolveOptions options;
  options.form_factors = GetParam().form_factors;
  options.elements = GetParam().elements;
  options.error = GetParam().error;
  const auto solve = solved(publishedCornellBox(), options);
  const ErrorEstimate total = solve->estimate(256).total;
  const Truth points = truth();
  const double error = reflectedError(points, answerProbes(solve->snapshot(), probesOf(points), false));
  measured("error", error);
  measured("estimated", total.value);
  measured("interval, low", total.low);
  measured("interval, high", total.high);
  EXPECT_EQ(total.places, 256u);
  EXPECT_GE(error, total.low);
  EXPECT_LE(error, total.high);
  EXPECT_LT(total.high, 5 * error);
}

INSTANTIATE_TEST_SUITE_P(Meshes, CornellEstimates,
                         testing::Values(Fineness{"Hemicubes1000", "hemicube", 1'000, 0.002},
                                         Fineness{"Hemicubes3000", "hemicube", 3'000, 0.002},
                                         Fineness{"Hemicubes10000", "hemicube", 10'000, 0.002},
                                         Fineness{"Unfinished", "hemicube", 10'000, 0.05},
                                         Fineness{"Rays5Percent", "rays", {}, 0.05},
                                         Fineness{"Rays2Percent", "rays", {}, 0.02},
                                         Fineness{"Rays1Percent", "rays", {}, 0.01}),
                         [](const auto& row) { return row.param.name; });

// With exact factors what is left is the mesh's; with hemicubes of few pixels the factors' error is what
// differs from the solution with many.
TEST(FormFactorEstimates, KnowExactFactorsFromCoarseOnes) {
  const auto exact = solved(cubeOneFaceLit(0.5), optionsOf("closed-form", 600, 1e-4));
  const ErrorEstimates of_exact = exact->estimate(128);
  measured("closed form", of_exact.form_factor.value);
  EXPECT_LT(of_exact.form_factor.low, 0.005);
  EXPECT_LT(of_exact.form_factor.value, 0.02);
  SolveOptions options = optionsOf("hemicube", 600, 1e-4);
  options.hemicube_resolution = 8;
  const auto coarse = solved(cubeOneFaceLit(0.5), options);
  options.hemicube_resolution = 256;
  const auto fine = solved(cubeOneFaceLit(0.5), options);
  double difference = 0, whole = 0;
  const Snapshot a = coarse->snapshot(), b = fine->snapshot();
  for (std::size_t e = 0; e < a.element_irradiance.size(); ++e) {
    if (a.mesh->sides[a.mesh->element_side[e]].emission != glm::dvec3(0.0)) continue;
    const double area = a.mesh->element_area[e];
    difference += area * std::pow(a.element_irradiance[e].x - b.element_irradiance[e].x, 2);
    whole += area * std::pow(b.element_irradiance[e].x, 2);
  }
  const double truth = std::sqrt(difference / whole);
  const ErrorEstimates of_coarse = coarse->estimate(256);
  measured("8 pixels, truly", truth);
  measured("8 pixels, estimated", of_coarse.form_factor.value);
  EXPECT_GE(truth, of_coarse.form_factor.low - 0.01);
  EXPECT_LE(truth, of_coarse.form_factor.high + 0.01);
  EXPECT_GT(of_coarse.form_factor.value, 3 * of_exact.form_factor.value);
  const ErrorEstimates of_fine = fine->estimate(16);
  measured("8 pixels, reciprocity", of_coarse.defects.reciprocity.value());
  measured("256 pixels, reciprocity", of_fine.defects.reciprocity.value());
  measured("closed form, reciprocity", of_exact.defects.reciprocity.value());
  EXPECT_GT(of_coarse.defects.reciprocity.value(), 4 * of_fine.defects.reciprocity.value());
  // Exact factors are exact at points: over elements they keep the laws the better the finer these are.
  const FormFactorDefects finer =
      solved(cubeOneFaceLit(0.5), optionsOf("closed-form", 2'400, 1e-4))->estimate(16).defects;
  measured("closed form, finer, reciprocity", finer.reciprocity.value());
  EXPECT_LT(finer.reciprocity.value(), 0.75 * of_exact.defects.reciprocity.value());
  EXPECT_LT(finer.closure.value(), 0.75 * of_exact.defects.closure.value());
}

}  // namespace
}  // namespace unshot
