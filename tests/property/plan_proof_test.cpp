// Each decision of the plan on each scene, on and off: the light is the same within the decision's own bound.
// What it saves is printed.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/obj_reader.h"
#include "session/scene_plan.h"
#include "support/assets.h"
#include "support/plan_pairs.h"
#include "support/run_program.h"
#include "support/scenes.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

struct ProofScene {
  std::string name;
  std::function<Scene()> make;
  double error;  // to be asked for
};

std::vector<ProofScene> proofScenes() {
  return {{"furnace", [] { return readObj(asset("furnace.obj")); }, 0.02},
          {"two_patches", [] { return readObj(asset("two_patches.obj")); }, 0.02},
          {"cornell_box", [] { return readObj(asset("cornell_box.obj")); }, 0.05},
          {"published", publishedCornellBox, 0.05},
          {"room",
           [] {
             const TempFolder folder;
             return readObj(writeRoom(folder));
           },
           0.02},
          {"room_with_box",
           [] {
             const TempFolder folder;
             return readObj(writeRoom(folder, boxObj()));
           },
           0.05},
          {"two_rooms", [] { return readObj(asset("two_rooms.obj")); }, 0.1}};
}

class PlanProof : public testing::TestWithParam<ProofScene> {
 protected:
  // Solved, and its error estimated.
  static std::unique_ptr<Solve> estimated(const SolveOptions& options) {
    auto solve = solved(GetParam().make(), options);
    solve->estimate(256);
    return solve;
  }
  static double cpu(const Solve& solve) { return solve.seconds().cpu_solve; }
  // What it says of itself, or was asked for.
  static double error(const Solve& solve) {
    return std::max(solve.estimates().total.high, solve.options().error);
  }
};

// With the mesh that the program chooses. The two are no farther apart than what both say of themselves.
TEST_P(PlanProof, WithinTheErrorOfBoth) {
  SolveOptions options = soonest(GetParam().error);
  options.emit_front_only = true;
  const auto lean = estimated(options);
  for (const PlanDecision& decision : lean->plan()) {
    options.do_anyway = {decision.key};
    const auto with = estimated(options);
    const double apart = difference(*with, *lean);
    measured(decision.key + ": apart", apart);
    measured(decision.key + ": CPU with it over without", cpu(*with) / cpu(*lean));
    EXPECT_LT(apart, error(*lean) + error(*with)) << decision.key;
    EXPECT_EQ(keysOf(*with).count(decision.key), 0u) << decision.key;
  }
  options.do_anyway = doAll();
  const auto all = estimated(options);
  measured("everything: apart", difference(*all, *lean));
  measured("everything: CPU over that of the plan", cpu(*all) / cpu(*lean));
  EXPECT_LT(difference(*all, *lean), error(*lean) + error(*all));
  for (const PlanDecision& decision : all->plan()) EXPECT_EQ(decision.key, plan_keys::kShooters);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PlanProof, testing::ValuesIn(proofScenes()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace unshot
