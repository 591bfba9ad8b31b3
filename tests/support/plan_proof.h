// A scene solved as the plan has it, with each of its decisions off, and with all of them off: the light is
// the same within what is said of each. What it saves is printed.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "session/scene_plan.h"
#include "support/plan_pairs.h"
#include "support/solving.h"

namespace unshot::testing_support {

struct ProofScene {
  std::string name;
  std::function<Scene()> make;
  double error;  ///< to be asked for
  /// Of each solve; without one it must converge.
  std::optional<double> max_seconds = std::nullopt;
};

/// Solved, and its error estimated.
inline std::unique_ptr<Solve> estimated(const ProofScene& scene, const SolveOptions& options) {
  auto solve = begun(scene.make(), options);
  while (solve->state() == SolveState::kRunning) solve->step();
  EXPECT_TRUE(solve->state() == SolveState::kConverged || solve->stoppedBy() == "max_seconds")
      << solve->stoppedBy();
  solve->estimate(256);
  return solve;
}

/// What it says of itself, or was asked for.
inline double saidError(const Solve& solve) {
  return std::max(solve.estimates().total.high, solve.options().error);
}

inline double cpuOf(const Solve& solve) { return solve.seconds().cpu_solve; }

/// With the mesh that the program chooses, which the work that is left out may change: both ways are no
/// farther apart than what both say of themselves.
inline void expectWithinTheErrorOfBoth(const ProofScene& scene) {
  constexpr double kShort = 1;  // [s]: of a longer solve, what a process does once is little
  SolveOptions options = soonest(scene.error);
  options.max_seconds = scene.max_seconds;
  options.emit_front_only = true;
  auto lean = estimated(scene, options);
  if (cpuOf(*lean) < kShort) lean = estimated(scene, options);
  measured("plan over the solve", lean->seconds().plan / cpuOf(*lean));
  // Others that run beside it make it longer.
  if (cpuOf(*lean) > kShort) {
    EXPECT_LT(lean->seconds().plan, 0.05 * cpuOf(*lean));
  }
  for (const PlanDecision& decision : lean->plan()) {
    options.do_anyway = {decision.key};
    const auto with = estimated(scene, options);
    const double apart = difference(*with, *lean);
    measured(decision.key + ": apart", apart);
    measured(decision.key + ": CPU with it over without", cpuOf(*with) / cpuOf(*lean));
    EXPECT_LT(apart, saidError(*lean) + saidError(*with)) << decision.key;
    EXPECT_EQ(keysOf(*with).count(decision.key), 0u) << decision.key;
  }
  options.do_anyway = doAll();
  const auto all = estimated(scene, options);
  measured("everything: apart", difference(*all, *lean));
  measured("everything: CPU over that of the plan", cpuOf(*all) / cpuOf(*lean));
  EXPECT_LT(difference(*all, *lean), saidError(*lean) + saidError(*all));
  for (const PlanDecision& decision : all->plan()) EXPECT_EQ(decision.key, plan_keys::kShooters);
}

/// What is said to be exact, with even elements of the same number: to rounding. Both ways are solved to 1e-6
/// of the light, and add up the same numbers. Rays in the place of formulas do not quite: from afar they take
/// the factors of patches that emit little as sums over a few points (FactorPolygon::quick), which is off by
/// 0.3 % at four radii, by less than a hundredth of that farther away, and as often too much as too little;
/// the light on all scenes here is 9e-6 apart at most.
inline void expectExactToRounding(const ProofScene& scene, std::uint64_t elements) {
  constexpr double kSolved = 1e-6, kFromAfar = 5e-5;
  SolveOptions options = soonest(kSolved);
  options.emit_front_only = true;
  options.elements = elements;
  const auto lean = solved(scene.make(), options);
  for (const PlanDecision& decision : lean->plan()) {
    if (decision.bound > 0) continue;
    options.do_anyway = {decision.key};
    const auto with = solved(scene.make(), options);
    const double apart = difference(*with, *lean);
    measured(decision.key + ": apart on the same mesh", apart);
    ASSERT_EQ(with->mesh().vertices.size(), lean->mesh().vertices.size());
    EXPECT_LE(apart, 2 * kSolved + (decision.key == plan_keys::kOcclusion ? kFromAfar : 0)) << decision.key;
  }
}

}  // namespace unshot::testing_support
