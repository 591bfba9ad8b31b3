// Loading that a user gives up.
#include <gtest/gtest.h>

#include "support/landscape.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using namespace testing_support;

class GivenUp : public testing::TestWithParam<const char*> {};

TEST_P(GivenUp, LoadingLeavesTheSceneBefore) {
  const TempFolder folder;
  folder.write("land.mtl", kLandscapeMaterials);
  const std::string landscape_file = folder.write("land.obj", landscape(200));
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 200;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const std::uint64_t first = live->state().epoch;
  live->perform("elements", "300");
  ASSERT_TRUE(live.until([&] { return live->state().epoch > first; }));
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  const std::uint64_t epoch = live->state().epoch;
  live->perform("open", landscape_file);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kLoading));
  live->perform(GetParam());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  live.draw();
  EXPECT_EQ(live->state().epoch, epoch);
  EXPECT_EQ(live->state().facts->scene_name, "cornell_box");
  EXPECT_EQ(live->ui().options.elements, 300u);
  EXPECT_FALSE(live->error());
  EXPECT_EQ(live->exitCode(), 0);
  live->perform("reflectance", "white 0.5,0.5,0.5");  // of the scene that stays
  EXPECT_FALSE(live->error());
}

INSTANTIATE_TEST_SUITE_P(Gui, GivenUp, testing::Values("give-up", "dismiss"), [](const auto& given) {
  return given.param == std::string("dismiss") ? "Dismiss" : "GiveUp";
});

}  // namespace
}  // namespace unshot
