// Error figures against a reference, and when it is too noisy to give them.
#include "report/reference_error.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/dice.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using Values = std::vector<std::optional<glm::dvec3>>;

ReferencePoint referencePointOf(double reflected, double emission = 0, double standard_error = 0) {
  ReferencePoint point;
  point.emission = glm::dvec3(emission);
  point.radiosity = glm::dvec3(emission + reflected);
  point.standard_error = glm::dvec3(standard_error);
  return point;
}

TEST(ReferenceError, IsOfReflectedLightAtPointsThatDoNotShine) {
  const std::vector<ReferencePoint> reference{referencePointOf(3), referencePointOf(4),
                                              referencePointOf(1, 1000)};
  const ReferenceError e = errorAgainst(reference, Values{glm::dvec3(3), glm::dvec3(5), glm::dvec3(0)});
  EXPECT_EQ(e.points, 2u);
  EXPECT_DOUBLE_EQ(e.nrmse, 1 / 5.0);
  EXPECT_DOUBLE_EQ(e.nrmse_raw, 1 / 5.0);
  EXPECT_DOUBLE_EQ(e.bias, 1 / 7.0);
  EXPECT_DOUBLE_EQ(e.worst_5, 1 / 4.0);
  EXPECT_EQ(e.noise, 0);
}

TEST(ReferenceError, LeavesEmissionOutWhereEveryPointShines) {
  const std::vector<ReferencePoint> reference{referencePointOf(1, 1000), referencePointOf(1, 1000)};
  const ReferenceError e = errorAgainst(reference, Values{glm::dvec3(1001.5), glm::dvec3(1001.5)});
  EXPECT_EQ(e.points, 2u);
  EXPECT_NEAR(e.nrmse, 0.5, 1e-12);
  EXPECT_NEAR(e.bias, 0.5, 1e-12);
}

TEST(ReferenceError, CountsMissingValuesAsDark) {
  const std::vector<ReferencePoint> reference{referencePointOf(3), referencePointOf(4)};
  const ReferenceError e = errorAgainst(reference, Values{glm::dvec3(3), std::nullopt});
  EXPECT_EQ(e.missing, 1u);
  EXPECT_DOUBLE_EQ(e.nrmse, 4 / 5.0);
  EXPECT_EQ(errorAgainst({}, {}).nrmse, 0);
}

TEST(ReferenceError, HasMedianAndWorstTwentiethOfRelativeErrors) {
  std::vector<ReferencePoint> reference;
  Values values;
  for (int k = 1; k <= 100; ++k) {
    reference.push_back(referencePointOf(1));
    values.emplace_back(glm::dvec3(1 + k / 100.0));
  }
  // Too dim to be asked for a relative error.
  reference.push_back(referencePointOf(1e-3));
  values.emplace_back(glm::dvec3(1));
  const ReferenceError e = errorAgainst(reference, values);
  EXPECT_NEAR(e.median, 0.5, 0.011);
  EXPECT_NEAR(e.worst_5, 0.98, 1e-12);
}

// A solution that is exact but for 2 % at every point, a reference whose noise is 3 %.
TEST(ReferenceError, LeavesOutTheReferencesOwnNoise) {
  testing_support::Dice dice(5);
  std::vector<ReferencePoint> reference;
  Values values;
  for (int k = 0; k < 20'000; ++k) {
    ReferencePoint point = referencePointOf(1, 0, 0.03);
    for (int c = 0; c < 3; ++c) point.radiosity[c] += 0.03 * std::sqrt(12.0) * (dice.uniform() - 0.5);
    reference.push_back(point);
    values.emplace_back(glm::dvec3(1.02));
  }
  const ReferenceError e = errorAgainst(reference, values);
  EXPECT_NEAR(e.noise, 0.03, 1e-4);
  EXPECT_NEAR(e.nrmse_raw, std::hypot(0.02, 0.03), 5e-4);
  EXPECT_NEAR(e.nrmse, 0.02, 5e-4);
  EXPECT_FALSE(isJudgeable(e));
  EXPECT_THAT(whyNotJudgeable(e), HasSubstr("too large to judge"));
}

TEST(ReferenceError, IsJudgeableWhereTheNoiseIsAThirdOfItAtMost) {
  const Values values{glm::dvec3(1.1)};
  const std::vector<ReferencePoint> good{referencePointOf(1, 0, 0.03)}, poor{referencePointOf(1, 0, 0.04)},
      none{referencePointOf(1, 0, std::numeric_limits<double>::infinity())};
  EXPECT_TRUE(isJudgeable(errorAgainst(good, values)));
  EXPECT_EQ(whyNotJudgeable(errorAgainst(good, values)), "");
  EXPECT_FALSE(isJudgeable(errorAgainst(poor, values)));
  EXPECT_FALSE(isJudgeable(errorAgainst(none, values)));
  EXPECT_THAT(whyNotJudgeable(errorAgainst(none, values)), HasSubstr("no standard error"));
}

}  // namespace
}  // namespace unshot
