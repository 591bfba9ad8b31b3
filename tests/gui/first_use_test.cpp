// Scenes that a new user may come with: empty, broken, dark and very large ones. What the window says of them
// is enough to go on with.
#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <optional>
#include <utility>

#include "gui/support/mouse.h"
#include "support/landscape.h"
#include "support/temp_folder.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using namespace testing_support;

class FirstUse : public testing::Test {
 protected:
  LiveViewer& open(const std::string& text) {
    LiveViewer::Options options;
    options.scene = folder_.write("mine.obj", text);
    options.width = 900;
    options.height = 600;
    live_.emplace(options);
    return *live_;
  }
  /// The message that is to be read.
  std::string message() {
    Mouse(*live_).frames(3);
    const ImGuiWindow* window = ImGui::FindWindowByName("message");
    return window && window->Active ? lettersOf(*window) : std::string();
  }

  TempFolder folder_;
  std::optional<LiveViewer> live_;
};

TEST_F(FirstUse, AnEmptySceneSaysSoAndWhatToDo) {
  for (const auto& [text, why] : {std::pair("", "isempty"), std::pair("# nothing\n", "noline"),
                                  std::pair("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "nofaces")}) {
    LiveViewer& live = open(text);
    ASSERT_TRUE(live.until([&] { return live->error().has_value(); })) << text;
    const std::string said = message();
    EXPECT_THAT(said, HasSubstr("mine.obj"));
    EXPECT_THAT(said, HasSubstr(why));
    EXPECT_THAT(said, HasSubstr("Try:"));
    EXPECT_EQ(live->state().phase, SessionPhase::kEmpty);
    const ImGuiWindow* empty = ImGui::FindWindowByName("empty");
    ASSERT_TRUE(empty && empty->Active);
    EXPECT_THAT(lettersOf(*empty), HasSubstr("Ctrl+O"));
    // It is not the end: another scene is opened.
    live->perform("dismiss");
    live->perform("open", std::string(UNSHOT_SOURCE_DIR) + "/assets/two_patches.obj");
    EXPECT_TRUE(live.untilPhase(SessionPhase::kConverged));
    EXPECT_FALSE(live->error());
  }
}

// No face emits, and the sky that is there instead shines on the outside alone.
TEST_F(FirstUse, ADarkRoomSaysWhatToDo) {
  LiveViewer& live = open(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 1 4 8 5\nf 4 3 7 8\n");
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return !live->messages().lines().empty(); }));
  EXPECT_THAT(live->messages().lines().back(), HasSubstr("Make it a light"));
}

TEST_F(FirstUse, ABrokenSceneSaysWhere) {
  LiveViewer& live = open("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  ASSERT_TRUE(live.until([&] { return live->error().has_value(); }));
  EXPECT_THAT(message(), HasSubstr("mine.obj:4"));
}

// 204,802 triangles: it shoots, says what is left out and how far it is, and answers.
TEST_F(FirstUse, AHugeSceneIsShownWhileItIsSolved) {
  folder_.write("land.mtl", kLandscapeMaterials);
  LiveViewer& live = open(landscape(320));
  ASSERT_TRUE(live.until([&] { return live->state().measures.shots >= 1; }));
  ASSERT_TRUE(live.until([&] { return live->shownSnapshot() && !live->drawingScene(); }));
  EXPECT_FALSE(live->error());
  EXPECT_EQ(live->state().facts->triangles, 204'802u);
  live->pause();
  ASSERT_TRUE(live.untilPhase(SessionPhase::kPaused));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  Mouse(live).frames(3);
  for (const std::string& problem : LayoutCheck(ImVec2(900, 600)).problems()) ADD_FAILURE() << problem;
}

}  // namespace
}  // namespace unshot
