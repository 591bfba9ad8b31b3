// Light by bounces: exact in a furnace, and on the Cornell box what Jacobi's sweeps add.
#include <gtest/gtest.h>

#include "scene/analytic_scenes.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

void finishBounces(Solve& solve) {
  while (solve.hasBouncesToWorkOut(true)) solve.workOutBounces(true);
}

class BouncesOf : public testing::TestWithParam<FormFactorMethodRow> {};

// B_k = rho^k E everywhere, so that each bounce has rho times the power of the one before.
TEST_P(BouncesOf, AFurnaceFallByTheReflectance) {
  // Form factors with occlusion are those of Gauss's rule for patches of little emission, from four radii on:
  // 0.3 % off at worst (polygon_factor.h), which cancels over the many patches of a wall to 4e-6 of all.
  const bool quick = GetParam().info.key == "rays" || GetParam().info.key == "hemicube-visibility";
  for (const double rho : {0.5, 0.9}) {
    const auto solve = solved(furnaceScene(rho, 1 - rho), optionsOf(GetParam().info.key, 600, 0.01));
    finishBounces(*solve);
    const Snapshot snapshot = solve->snapshot();
    ASSERT_TRUE(snapshot.bounce_light);
    const std::vector<glm::dvec3>& power = snapshot.bounce_light->power;
    ASSERT_GT(power.size(), 12u);
    double worst = 0;
    for (std::size_t k = 1; k < power.size(); ++k)
      worst = std::max(worst, std::abs(power[k].x / power[k - 1].x / rho - 1));
    measured("ratio over rho", worst);
    EXPECT_LT(worst, quick ? 1e-5 : 1e-7);
    EXPECT_NEAR(power[0].x, 6 * (1 - rho), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, BouncesOf,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

double powerOf(const Solve& solve) {
  double sum = 0;
  const std::vector<glm::dvec3> b = solve.patchRadiosity();
  for (std::size_t q = 0; q < b.size(); ++q) sum += solve.mesh().patch_area[q] * (b[q].x + b[q].y + b[q].z);
  return sum;
}

TEST(Bounces, OfTheCornellBoxAreWhatEachSweepOfJacobiAdds) {
  const auto whole = solved(publishedCornellBox(), optionsOf("hemicube", 600, 1e-6));
  finishBounces(*whole);
  const std::vector<glm::dvec3> power = whole->snapshot().bounce_light->power;
  const auto received = whole->snapshot().bounce_light->received;
  double before = 0;
  for (std::uint64_t n = 1; n <= 4; ++n) {
    SolveOptions options = optionsOf("hemicube", 600, 0.01);
    options.bounces = n;
    const auto swept = solved(publishedCornellBox(), options);
    EXPECT_EQ(swept->stoppedBy(), "bounces");
    EXPECT_EQ(swept->modeKey(), "jacobi");
    if (n == 1) before = power[0].x + power[0].y + power[0].z;
    const double now = powerOf(*swept), added = power[n].x + power[n].y + power[n].z;
    EXPECT_NEAR(now - before, added, 1e-9 * added) << n;
    before = now;
    const Snapshot snapshot = swept->snapshot();
    for (std::size_t v = 0; v < snapshot.irradiance.size(); v += 7) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(received[n - 1]->vertices[v][c], snapshot.irradiance[v][c],
                    1e-5f * (1e-3f + snapshot.irradiance[v][c]));
    }
  }
  // Later bounces tend to the spectral radius.
  ASSERT_LT(whole->bounds().spectralRadiusUpper().x, 1);
  const glm::dvec3 last = power.back() / power[power.size() - 2];
  for (int c = 0; c < 3; ++c) {
    EXPECT_LE(last[c], whole->bounds().spectralRadiusUpper()[c] * 1.001);
    EXPECT_GE(last[c], whole->bounds().spectralRadiusLower()[c] * 0.95);
  }
}

TEST(Bounces, TakeTheModeJacobiOnly) {
  SolveOptions options = optionsOf("closed-form", 100, 0.01);
  options.bounces = 2;
  options.mode = "southwell";
  EXPECT_THROW(begun(furnaceScene(0.5, 0.5), options), Error);
  options.mode = "jacobi";
  EXPECT_EQ(solved(furnaceScene(0.5, 0.5), options)->stoppedBy(), "bounces");
}

// Where all light goes on for ever there is no solution, but each bounce is there.
TEST(Bounces, AreThereWhereThereIsNoSolution) {
  SolveOptions options = optionsOf("closed-form", 100, 0.01);
  options.bounces = 30;
  const auto solve = solved(furnaceScene(1, 1), options);
  const Snapshot snapshot = solve->snapshot();
  EXPECT_NEAR(radiosity(snapshot, 0, false).x, 31, 1e-3);
}

}  // namespace
}  // namespace unshot
