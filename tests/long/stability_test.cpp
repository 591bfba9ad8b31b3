// The whole stability suite: every case by every mode and by every method, the slow and the largest too.
#include "support/stability.h"

#include <gtest/gtest.h>

namespace unshot {
namespace {

using namespace testing_support;

class StabilitySuiteOfModes : public testing::TestWithParam<IterationModeRow> {};

TEST_P(StabilitySuiteOfModes, HoldsInEveryCase) {
  for (const StabilityCase& trial : stabilityCases())
    expectStable(trial, std::string(GetParam().info.key), "auto");
}

INSTANTIATE_TEST_SUITE_P(Modes, StabilitySuiteOfModes,
                         testing::ValuesIn(iterationModes().begin(), iterationModes().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

class StabilitySuiteOfMethods : public testing::TestWithParam<FormFactorMethodRow> {};

TEST_P(StabilitySuiteOfMethods, HoldsInEveryCase) {
  for (const StabilityCase& trial : stabilityCases())
    expectStable(trial, "auto", std::string(GetParam().info.key));
}

INSTANTIATE_TEST_SUITE_P(Methods, StabilitySuiteOfMethods,
                         testing::ValuesIn(formFactorMethods().begin(), formFactorMethods().end()),
                         [](const auto& row) { return testName(row.param.info.key); });

}  // namespace
}  // namespace unshot
