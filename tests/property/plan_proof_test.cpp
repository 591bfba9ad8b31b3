// Each decision of the plan on each scene, on and off: the light is the same within the decision's own bound.
// What it saves is printed. Scenes that take minutes are in long/plan_proof_test.cpp.
#include "support/plan_proof.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/analytic_scenes.h"
#include "scene/obj_reader.h"
#include "support/assets.h"
#include "support/run_program.h"
#include "support/scenes.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

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
          {"two_rooms", [] { return readObj(asset("two_rooms.obj")); }, 0.1},
          {"glowing_cube", [] { return furnaceScene(0.9, 0.1); }, 0.02},
          {"cube_one_face_lit", [] { return cubeOneFaceLit(0.5); }, 0.02},
          {"parallel_squares", [] { return parallelSquares(0.5); }, 0.02},
          {"perpendicular_squares", [] { return perpendicularSquares(0.5); }, 0.02},
          {"concentric_spheres", [] { return concentricSpheres(0.5, 1, 0.5, 0, 8); }, 0.05},
          {"lit_and_dark_room", litAndDarkRoom, 0.05}};
}

class PlanProof : public testing::TestWithParam<ProofScene> {};

TEST_P(PlanProof, WithinTheErrorOfBoth) { expectWithinTheErrorOfBoth(GetParam()); }

TEST_P(PlanProof, ExactToRounding) { expectExactToRounding(GetParam(), 600); }

INSTANTIATE_TEST_SUITE_P(Scenes, PlanProof, testing::ValuesIn(proofScenes()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace unshot
