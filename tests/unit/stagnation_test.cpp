// Scenes on the border of having no solution, which must neither be taken for ones without nor the other way.
#include <gtest/gtest.h>

#include <memory>

#include "scene/analytic_scenes.h"
#include "session/solve.h"
#include "solver/modes.h"

namespace unshot {
namespace {

std::unique_ptr<Solve> ended(double reflectance, std::string_view mode, std::uint64_t elements) {
  SolveOptions options;
  options.form_factors = "closed-form";
  options.elements = elements;
  options.error = 0.01;
  options.mode = mode;
  auto solve = std::make_unique<Solve>(furnaceScene(reflectance, 1), options, nullptr);
  while (solve->state() == SolveState::kRunning) solve->step(Solve::kMostAtOnce);
  return solve;
}

// Closed-form columns do not conserve power to the last digit: while light spreads from the even start to
// what the columns hold on to, nothing is lost for forty passes.
TEST(Stagnation, IsNotTakenForWhatTakesLong) {
  const auto solve = ended(0.9999, "southwell", 54);
  EXPECT_EQ(solve->state(), SolveState::kConverged) << solve->stoppedBy();
}

TEST(NoSolution, IsSaidByEveryMode) {
  for (const IterationModeRow& row : iterationModes()) {
    const auto solve = ended(1, row.info.key, 96);
    ASSERT_EQ(solve->state(), SolveState::kFailed) << row.info.key;
    EXPECT_EQ(solve->failure()->kind(), ErrorKind::kInput) << row.info.key;
  }
}

}  // namespace
}  // namespace unshot
