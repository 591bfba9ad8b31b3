// An edit while the solve is live takes less than a solve from the start.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/clock.h"
#include "scene/obj_reader.h"
#include "support/sanitized.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

// CPU from before a solve is made until its bound is below the error asked for.
template <class Make>
double secondsTo(double error, std::unique_ptr<Solve>& solve, Make&& make) {
  const double began = cpuSeconds();
  solve = make();
  while (solve->state() == SolveState::kRunning && solve->measures().solverBound() > error)
    solve->step(Solve::kMostAtOnce);
  const double took = cpuSeconds() - began;
  EXPECT_LE(solve->measures().solverBound(), error);
  while (solve->state() == SolveState::kRunning) solve->step(Solve::kMostAtOnce);
  return took;
}

// A wall of the converged Cornell box is painted: asked for is less than a fifth, 0.1 is measured. The least
// of three, as a busy machine only adds.
TEST(EditCost, OfAWallIsAFractionOfAFreshSolve) {
  double least = INFINITY;
  for (int round = 0; round < 3; ++round) {
    SolveOptions options;
    options.soonest = true;
    const auto gl = []() -> gl::Context& { return sharedContext(); };
    std::unique_ptr<Solve> solve;
    const double fresh = secondsTo(0.01, solve, [&] {
      return std::make_unique<Solve>(readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj"), options, gl);
    });
    std::vector<Material> materials = solve->scene().materials;
    const auto red =
        std::find_if(materials.begin(), materials.end(), [](const Material& m) { return m.name == "red"; });
    ASSERT_NE(red, materials.end());
    red->reflectance = {0.1, 0.3, 0.75};
    const std::unique_ptr<Solve> before = std::move(solve);
    const double edit =
        secondsTo(0.01, solve, [&] { return std::make_unique<Solve>(*before, materials, gl); });
    measured("CPU s from the start", fresh);
    measured("CPU s after the edit", edit);
    least = std::min(least, edit / fresh);
  }
  measured("least ratio", least);
  if (!kSanitized) {
    EXPECT_LT(least, 0.2);
  }
}

}  // namespace
}  // namespace unshot
