// The whole stability suite: every case by every mode and by every method, the largest too.
#include "support/stability.h"

#include <gtest/gtest.h>

namespace unshot {
namespace {

using namespace testing_support;

TEST(StabilitySuite, HoldsByEveryMode) {
  for (const StabilityCase& trial : stabilityCases()) {
    for (const IterationModeRow& row : iterationModes())
      expectStable(trial, std::string(row.info.key), "auto");
  }
}

TEST(StabilitySuite, HoldsByEveryMethod) {
  for (const StabilityCase& trial : stabilityCases()) {
    for (const FormFactorMethodRow& row : formFactorMethods())
      expectStable(trial, "auto", std::string(row.info.key));
  }
}

}  // namespace
}  // namespace unshot
