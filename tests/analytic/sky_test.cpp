// A uniform sky, against exact values and the path-traced reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formfactor/polygon_factor.h"
#include "support/solving.h"
#include "support/test_scenes.h"
#include "support/truth.h"

namespace unshot {
namespace {

using namespace testing_support;

const glm::dvec3 kSky(1, 0.5, 2);

SolveOptions underSky(std::string_view method, double error = 1e-4) {
  SolveOptions options;
  options.form_factors = method;
  options.elements = 1000;
  options.error = error;
  options.sky = kSky;
  return options;
}

// A box without a lid, [0, 1]^3, fronts inwards.
Scene openBox(double reflectance) {
  SceneBuilder b;
  const auto wall = b.material("wall", glm::dvec3(reflectance));
  addBox(b, {wall, wall, wall, kNone, wall, wall}, {0, 0, 0}, {1, 1, 1}, true);
  return b.finish();
}

class SkyOverMethods : public testing::TestWithParam<FormFactorMethodRow> {};

// The sky's light goes nowhere but into the sky again.
TEST_P(SkyOverMethods, LightsASheetInTheOpenFromBothSides) {
  SceneBuilder b;
  b.quad(b.material("sheet", glm::dvec3(0.5)), {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
  const auto solve = solved(b.finish(), underSky(GetParam().info.key));
  const std::vector<glm::dvec3> h = sideMeans(solve->snapshot());
  ASSERT_EQ(h.size(), 2u);
  for (const glm::dvec3& side : h) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(side[c], kSky[c], 1e-6 * kSky[c]);
  }
}

// Where all surfaces are as bright as the sky, E = (1 - rho) sky, everything is, whatever stands where. What
// is left is what rows of patches and sky lack of 1: most beside the block, part of which a vertex at its
// foot sees by one ray (1.4 % with rays).
TEST_P(SkyOverMethods, IsAsBrightAsSurfacesOfItsOwnRadiosity) {
  Scene scene = occludes(GetParam()) ? blockOnFloor(0.4) : openBox(0);
  for (Material& material : scene.materials) {
    material.reflectance = glm::dvec3(0.5, 0.7, 0.2);
    material.emission = (1.0 - material.reflectance) * kSky;
  }
  const auto solve = solved(scene, underSky(GetParam().info.key));
  const Snapshot snapshot = solve->snapshot();
  double worst = 0, squares = 0, area = 0;
  for (std::uint32_t e = 0; e < snapshot.mesh->element_count; ++e) {
    const Side& side = snapshot.mesh->sides[snapshot.mesh->element_side[e]];
    const double b = side.emission.y + side.reflectance.y * double{snapshot.element_irradiance[e].y};
    const double error = b / kSky.y - 1;
    worst = std::max(worst, std::abs(error));
    squares += snapshot.mesh->element_area[e] * error * error;
    area += snapshot.mesh->element_area[e];
  }
  measured("RMS error", std::sqrt(squares / area));
  measured("worst", worst);
  EXPECT_LT(std::sqrt(squares / area), occludes(GetParam()) ? 0.02 : 0.001);
}

// Rays do not pass where walls meet, so inside it is dark to the last bit and outside nothing is missing.
TEST_P(SkyOverMethods, StaysOutsideAClosedRoom) {
  const auto solve = solved(furnaceScene(0.5, 0), underSky(GetParam().info.key));
  const Mesh& mesh = solve->mesh();
  ASSERT_EQ(mesh.sides.size(), 12u);
  const std::vector<glm::dvec3> h = sideMeans(solve->snapshot());
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double open = mesh.sides[k].back ? 1 : 0;  // fronts face inwards
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(h[k][c], open * kSky[c], 1e-6 * kSky[c]);
    if (open == 0) {
      EXPECT_EQ(h[k], glm::dvec3(0.0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, SkyOverMethods,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

// Black walls: what arrives is the factor of the opening, which has a closed form.
TEST(Sky, ShinesThroughAnOpeningByItsFormFactor) {
  const auto solve = solved(openBox(0), underSky("rays"));
  const Snapshot snapshot = solve->snapshot();
  const glm::dvec3 lid[] = {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}};
  std::vector<glm::dvec3> scratch;
  double worst = 0, squares = 0;
  int count = 0;
  for (std::size_t v = 0; v < snapshot.mesh->vertices.size(); ++v) {
    const Vertex& vertex = snapshot.mesh->vertices[v];
    const Side& side = snapshot.mesh->sides[vertex.side];
    const glm::dvec3 at = glm::dvec3(vertex.position) + snapshot.mesh->frame_origin;
    // Of the floor inside, off the walls, where vertices look from a little within.
    if (side.back || side.normal.y < 0.5 || std::min({at.x, at.z, 1 - at.x, 1 - at.z}) < 0.05) continue;
    const double error =
        double{snapshot.irradiance[v].x} - pointToPolygonFactor(at, side.normal, lid, scratch);
    worst = std::max(worst, std::abs(error));
    squares += error * error;
    ++count;
  }
  ASSERT_GT(count, 50);
  measured("RMS error of an open view", std::sqrt(squares / count));
  measured("worst", worst);
  EXPECT_LT(std::sqrt(squares / count), 0.003);
  EXPECT_LT(worst, 0.01);
}

TEST(Sky, AndReflectionAgreeWithThePathTracedReference) {
  const Scene scene = blockOnFloor(0.4);
  ReferenceOptions tracing;
  tracing.points = 120;
  tracing.sky = kSky;
  tracing.relative_error = 0.005;
  tracing.max_samples = 4096;
  const Truth truth = traceReference(scene, tracing).points;
  for (const bool follows_light : {false, true}) {
    SolveOptions options = underSky("rays", 0.005);
    if (follows_light) options.elements.reset();
    const auto solve = solved(scene, options);
    const double error = reflectedError(truth, answerProbes(solve->snapshot(), probesOf(truth), false));
    measured("nRMSE", error);
    EXPECT_LT(error, 0.03);
    const ErrorEstimate estimate = solve->estimate(512).total;
    measured("estimated", estimate.value);
    measured("at most", estimate.high);
    EXPECT_EQ(estimate.places, 512u);
    EXPECT_LT(estimate.value, 0.03);
    EXPECT_GT(estimate.high, 0.7 * error);
  }
}

class SkyInModes : public testing::TestWithParam<IterationModeRow> {};

// The sky is a source that receives nothing, and of which modes know nothing.
TEST_P(SkyInModes, EndsAtTheSameLightAndAccountsForIt) {
  SolveOptions options = underSky("rays", 1e-8);
  options.elements = 150;
  options.mode = "direct";
  const std::vector<glm::dvec3> exact = sideRadiosities(solved(openBox(0.8), options)->snapshot());
  options.mode = GetParam().info.key;
  const auto solve = solved(openBox(0.8), options);
  const std::vector<glm::dvec3> b = sideRadiosities(solve->snapshot());
  for (std::size_t k = 0; k < b.size(); ++k) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[k][c], exact[k][c], 1e-6 * exact[k][c]);
  }
  EXPECT_NEAR(solve->energy().residual(), 0, 1e-9 * solve->energy().emitted);
}

INSTANTIATE_TEST_SUITE_P(Modes, SkyInModes,
                         testing::ValuesIn(iterationModes().begin(), iterationModes().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

TEST(Sky, IsThereOfItselfWhereNothingEmitsAndOnlyThere) {
  SolveOptions options = optionsOf("rays", 200, 0.01);
  EXPECT_EQ(solved(openBox(0.5), options)->sky(), glm::dvec3(1.0));
  EXPECT_EQ(solved(blockOnFloor(0.4), options)->sky(), glm::dvec3(0.0));
  options.sky = glm::dvec3(0.0);
  const auto dark = solved(openBox(0.5), options);
  EXPECT_EQ(dark->sky(), glm::dvec3(0.0));
  EXPECT_EQ(dark->stoppedBy(), "no light");
}

// A bounce of the sky's light is one reflection of it.
TEST(Sky, OfOneBounceIsWhatBlackWallsReceive) {
  SolveOptions options = underSky("rays");
  options.elements = 200;
  const std::vector<glm::dvec3> direct = sideMeans(solved(openBox(0), options)->snapshot());
  options.bounces = 1;
  const std::vector<glm::dvec3> once = sideMeans(solved(openBox(0.8), options)->snapshot());
  for (std::size_t k = 0; k < once.size(); ++k) EXPECT_NEAR(once[k].x, direct[k].x, 1e-6 * direct[k].x);
}

}  // namespace
}  // namespace unshot
