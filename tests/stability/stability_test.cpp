// The suite of `unshot selftest`: every case by the default mode and method; every mode and every method on
// all but the slow ones. (All of all: tests/long.)
#include "support/stability.h"

#include <gtest/gtest.h>

namespace unshot {
namespace {

using namespace testing_support;

TEST(Stability, EveryCaseHoldsByDefault) {
  for (const StabilityCase& trial : stabilityCases()) {
    if (!trial.large) expectStable(trial, "auto", "auto", Expected::kPass);
  }
}

// What a solve does without options.
TEST(Stability, EveryCaseHoldsOnAMeshThatFollowsTheLight) {
  for (const StabilityCase& trial : stabilityCases()) {
    if (!trial.large) expectStable(trial, "auto", "auto", Expected::kPass, Fineness::kLight);
  }
}

class StabilityOfModes : public testing::TestWithParam<IterationModeRow> {};

TEST_P(StabilityOfModes, HoldsInEveryCaseButTheSlow) {
  for (const StabilityCase& trial : stabilityCases()) {
    if (!trial.large && !trial.slow) expectStable(trial, std::string(GetParam().info.key), "auto");
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, StabilityOfModes,
                         testing::ValuesIn(iterationModes().begin(), iterationModes().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

class StabilityOfMethods : public testing::TestWithParam<FormFactorMethodRow> {};

TEST_P(StabilityOfMethods, HoldsInEveryCaseButTheSlow) {
  for (const StabilityCase& trial : stabilityCases()) {
    if (!trial.large && !trial.slow) expectStable(trial, "auto", std::string(GetParam().info.key));
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, StabilityOfMethods,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

}  // namespace
}  // namespace unshot
