// Each decision of the plan on each scene, on and off: the light is the same within the decision's own bound.
// What it saves is printed.
#include <gtest/gtest.h>

#include <cmath>

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
  double error;          // to be asked for
  double element_share;  // edge of an element over the scene's diagonal, where elements are to be the same
};

std::vector<ProofScene> proofScenes() {
  return {{"furnace", [] { return readObj(asset("furnace.obj")); }, 0.02, 0.1},
          {"two_patches", [] { return readObj(asset("two_patches.obj")); }, 0.02, 0.05},
          {"cornell_box", [] { return readObj(asset("cornell_box.obj")); }, 0.05, 0.05},
          {"published", publishedCornellBox, 0.05, 0.05},
          {"room",
           [] {
             const TempFolder folder;
             return readObj(writeRoom(folder));
           },
           0.02, 0.1},
          {"room_with_box",
           [] {
             const TempFolder folder;
             return readObj(writeRoom(folder, boxObj()));
           },
           0.05, 0.05},
          {"two_rooms", [] { return readObj(asset("two_rooms.obj")); }, 0.1, 0.03}};
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
  static double error(const Solve& solve) { return solve.estimates().total.high; }
};

// Those that may change the light by as much as the error asked for, with the mesh that the program chooses:
// the two are no farther apart than what both say of themselves.
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
  EXPECT_TRUE(all->plan().empty());
}

// Those that change nothing, on elements that are the same with them and without.
TEST_P(PlanProof, ToRoundingWhereItIsExact) {
  SolveOptions options = soonest(1e-6);
  options.emit_front_only = true;
  const Scene scene = GetParam().make();
  options.element_size = GetParam().element_share * glm::length(scene.bounds_max - scene.bounds_min);
  const auto lean = solved(GetParam().make(), options);
  options.form_factors = lean->formFactorsKey();
  std::size_t exact = 0;
  for (const PlanDecision& decision : lean->plan()) {
    if (decision.bound > 0 || decision.key == plan_keys::kOcclusion) continue;  // Plan.LeavesOutTestsOf...
    ++exact;
    options.do_anyway = {decision.key};
    const double apart = difference(*lean, *solved(GetParam().make(), options));
    measured(decision.key + ": apart", apart);
    EXPECT_LT(apart, 2e-3) << decision.key;
  }
  EXPECT_GT(exact, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PlanProof, testing::ValuesIn(proofScenes()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace unshot
