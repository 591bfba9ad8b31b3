// No energy is lost or made: emitted = absorbed + escaped + unshot (+ the methods' own, reported closure
// defect), at every step of every mode with every method.
#include <gtest/gtest.h>

#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct EnergyCase {
  FormFactorMethodRow method;
  IterationModeRow mode;
};

std::vector<EnergyCase> energyCases() {
  std::vector<EnergyCase> out;
  for (const FormFactorMethodRow& method : formFactorMethods()) {
    for (const IterationModeRow& mode : iterationModes()) out.push_back({method, mode});
  }
  return out;
}

class Energy : public testing::TestWithParam<EnergyCase> {
 protected:
  static void expectBalance(Scene scene, std::uint64_t elements, int most_steps) {
    SolveOptions options = optionsOf(GetParam().method.info.key, elements, 1e-6);
    options.mode = GetParam().mode.info.key;
    const auto solve = begun(std::move(scene), options);
    for (int step = 0; step < most_steps && solve->state() == SolveState::kRunning; ++step) {
      const EnergyBalance energy = solve->energy();
      // Sums of some thousand terms in double round to 1e-13; columns are floats, but their rounding is
      // counted as defect.
      ASSERT_LT(std::abs(energy.residual()), 1e-9 * energy.emitted) << "step " << step;
      solve->step();
    }
    const EnergyBalance end = solve->energy();
    measured("closure defect", end.closure_defect / end.emitted);
    measured("escaped", end.escaped / end.emitted);
    EXPECT_LT(std::abs(end.closure_defect), 0.02 * end.emitted);
  }
};

TEST_P(Energy, AddsUpInAClosedCube) { expectBalance(cubeOneFaceLit(0.8), 150, 400); }

TEST_P(Energy, AddsUpWhereLightEscapes) { expectBalance(parallelSquares(0.9), 100, 300); }

TEST_P(Energy, AddsUpInARoomOfConcaveSurfaces) {
  if (GetParam().method.info.key == "closed-form") return;  // it knows no occlusion
  expectBalance(lShapedRoom(), 200, 200);
}

INSTANTIATE_TEST_SUITE_P(Table, Energy, testing::ValuesIn(energyCases()), [](const auto& row) {
  return testName(row.param.method.info.key) + "_" + testName(row.param.mode.info.key);
});

}  // namespace
}  // namespace unshot
