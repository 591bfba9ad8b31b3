// What the viewer does between its frames: a picture that takes long does not keep the window from answering.
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <tuple>

#include "base/clock.h"
#include "export/image_files.h"
#include "render/element_edges.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/pace.h"

namespace unshot {
namespace {

using testing_support::LiveViewer;

/// The Cornell box with so many elements that a picture takes many slices on any machine, paused and drawn.
class ViewerFrames : public testing::Test {
 protected:
  ViewerFrames() : live_(options()) {
    live_->pause();
    const glm::dvec3 unframed = live_->camera().eye;
    // Inputs without a pause do not keep it from finding its camera either.
    EXPECT_TRUE(live_.until([&] {
      live_->input();
      return live_->camera().eye != unframed && live_->shownCamera().eye == live_->camera().eye;
    })) << "never framed";
    EXPECT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; })) << "never at rest";
  }
  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = UNSHOT_SOURCE_DIR "/assets/cornell_box.obj";
    options.solve.elements = 500'000;
    return options;
  }

  LiveViewer live_;
};

// The first picture holds the renderer's making of code, and so does one in a few later.
TEST(PictureCosts, KnowWhatAPictureTakesAsARule) {
  PictureCosts costs;
  EXPECT_EQ(costs.usual(), 0);
  costs.note(0.6);
  EXPECT_EQ(costs.usual(), 0);
  costs.note(0.04);
  EXPECT_EQ(costs.usual(), 0.04);
  for (const double cost : {0.05, 0.3, 0.06, 0.04}) costs.note(cost);
  EXPECT_EQ(costs.usual(), 0.05);
  for (int k = 0; k < 3; ++k) costs.note(0.2);
  EXPECT_EQ(costs.usual(), 0.2) << "another scene";
}

TEST_F(ViewerFrames, AnswerWhileThePictureIsMade) {
  live_->perform("display", "mesh");  // all edges of all elements take long, in coarse pictures too
  ASSERT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; }));
  const glm::dvec3 before = live_->shownCamera().eye;
  live_->navigator().orbit({40, 0}, 240);
  live_->input();
  ASSERT_TRUE(live_.until([this] { return live_->drawingScene(); }));
  live_->perform("help");
  const int painted = live_.painted();
  int answers = 0, slices = 0;
  while (live_->drawingScene()) {
    const glm::dvec3 shown = live_->shownCamera().eye;
    if (!live_.pump()) ++slices;
    if (!live_->drawingScene()) break;
    EXPECT_EQ(live_->shownCamera().eye, shown) << "half a picture";
    answers = live_.painted() - painted;
  }
  EXPECT_GE(answers, 1) << "the window waits for the picture";
  EXPECT_GE(slices, 3);
  EXPECT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; }));
  EXPECT_NE(live_->shownCamera().eye, before);
  EXPECT_EQ(live_->shownCamera().eye, live_->camera().eye);
}

// What is painted of the window before a picture keeps the picture waiting.
TEST_F(ViewerFrames, NothingElseIsPaintedBeforeThePictureThatTheMouseHasMoved) {
  ImGuiIO& io = ImGui::GetIO();
  const auto mouseAt = [&](float x) {
    io.MousePos = {x, 100};
    live_->notice("the mouse is at " + std::to_string(x));  // something else to be painted
  };
  mouseAt(100);
  for (int frame = 0; frame < 3; ++frame) live_.draw();
  io.MouseDown[0] = true;
  for (int frame = 0; frame < 3; ++frame) live_.draw();
  for (float x = 110; x < 150; x += 10) {
    const glm::dvec3 before = live_->camera().eye;
    ASSERT_EQ(live_->shownCamera().eye, before);
    mouseAt(x);
    const int painted = live_.painted();
    const double since = wallSeconds();
    while (live_.painted() == painted) live_.pump();
    ASSERT_NE(live_->camera().eye, before) << "the mouse does not turn the view";
    // A picture that takes very long is not waited for.
    if (wallSeconds() < since + 0.05) {
      EXPECT_EQ(live_->shownCamera().eye, live_->camera().eye);
    }
    ASSERT_TRUE(live_.until([this] { return live_->shownCamera().eye == live_->camera().eye; }));
  }
  io.MouseDown[0] = false;
}

TEST_F(ViewerFrames, AreCoarseWhileTheCameraMovesAndFineAtRestAndInFiles) {
  const testing_support::TempFolder folder;
  const std::string moving = folder / "moving.png", at_rest = folder / "at_rest.png";
  live_->navigator().orbit({40, 0}, 240);
  live_->input();
  ASSERT_TRUE(live_.until([this] { return live_->shownCamera().eye == live_->camera().eye; }));
  EXPECT_TRUE(live_->coarseScene());
  live_.performAndWait("screenshot-scene", moving);
  ASSERT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; }));
  EXPECT_FALSE(live_->coarseScene());
  EXPECT_EQ(live_->shownCamera().eye, live_->camera().eye);
  live_.performAndWait("screenshot-scene", at_rest);
  EXPECT_EQ(readImage(moving).rgb, readImage(at_rest).rgb);
}

TEST_F(ViewerFrames, InputsWithoutAPauseDoNotStarveThePicture) {
  const auto despite_inputs = [this](const std::function<bool()>& condition) {
    return live_.until([&] { return live_->input(), condition(); }, 60);
  };
  live_->navigator().orbit({40, 0}, 240);
  EXPECT_TRUE(despite_inputs([this] { return live_->shownCamera().eye == live_->camera().eye; })) << "camera";
  live_->resume();
  const std::shared_ptr<const Snapshot> before = live_->shownSnapshot();
  EXPECT_TRUE(despite_inputs([&] { return live_->shownSnapshot() != before; })) << "new light";
}

// The longest of the window's turns is far shorter than finding them takes.
TEST_F(ViewerFrames, EdgesAreFoundBesideTheWindow) {
  const double began = wallSeconds();
  const std::size_t edges = elementEdges(*live_->shownSnapshot()->mesh).size();
  const double alone = wallSeconds() - began;
  ASSERT_GT(edges, 1'000'000u);
  for (const char* display : {"mesh", "patches"}) {
    SCOPED_TRACE(display);
    live_->perform("display", display);
    double longest = 0;
    bool told = false;
    while (live_->nextFrame(0) < 1e30) {
      for (const Task& task : live_->tasks())
        told = told || task.text == "finding edges" || task.text == "colouring patches";
      const double from = wallSeconds();
      const bool busy = live_.pump() || live_->drawingScene();
      longest = std::max(longest, wallSeconds() - from);
      if (!busy) live_.rest(0.01);
    }
    EXPECT_TRUE(told || display == std::string("patches")) << "their colours take less time";
    EXPECT_LT(longest, alone / 2);
    EXPECT_EQ(live_->ui().settings.view.display, display);
    EXPECT_FALSE(live_->error());
  }
}

TEST_F(ViewerFrames, EdgesThatAreGivenUpLeaveTheDisplayBefore) {
  const int painted = live_.painted();
  live_->perform("display", "mesh");
  ASSERT_TRUE(live_.until([this] { return !live_->tasks().empty(); }));
  EXPECT_EQ(live_->tasks().front().text, "finding edges");
  live_->perform("give-up");
  EXPECT_EQ(live_->ui().settings.view.display, "radiosity");
  EXPECT_TRUE(live_->tasks().empty());
  EXPECT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; }));
  EXPECT_GT(live_.painted(), painted) << "not said";
  // Another display takes them back too.
  live_->perform("display", "mesh");
  ASSERT_TRUE(live_.until([this] { return !live_->tasks().empty(); }));
  live_->perform("display", "radiosity");
  EXPECT_TRUE(live_->tasks().empty());
  EXPECT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; }, 20));
  live_->perform("display", "mesh");
  EXPECT_TRUE(live_.until([this] { return live_->nextFrame(0) > 1e30; }));
  EXPECT_EQ(live_->ui().settings.view.display, "mesh");
}

TEST(ViewerFrame, IsDrawnAgainOnlyWhereItLooksOtherwise) {
  LiveViewer live(LiveViewer::Options{});
  const auto rest = [&] {
    EXPECT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
    return live.painted();
  };
  const int before = rest();
  EXPECT_GE(before, 1);
  live->input();
  EXPECT_EQ(rest(), before);
  live->perform("help");
  const int with_help = rest();
  EXPECT_GT(with_help, before);
  live->damaged();
  EXPECT_EQ(rest(), with_help + 1);
}

// Some window systems count in units of several pixels, and the framebuffer is larger than they say.
TEST(ViewerFrame, IsLaidOutInPixelsWhateverTheWindowSystemCountsIn) {
  const auto panelOf = [](float pixels_per_unit) {
    LiveViewer::Options options;
    options.scene = UNSHOT_SOURCE_DIR "/assets/cornell_box.obj";
    options.solve.elements = 200;
    options.width = 1280;
    options.height = 800;
    options.pixels_per_unit = pixels_per_unit;
    LiveViewer live(options);
    EXPECT_TRUE(live.untilPhase(SessionPhase::kConverged));
    EXPECT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
    const ImRect panel = ImGui::FindWindowByName("panel")->Rect();
    // The mouse finds what is drawn below it: a place in the middle of the scene is picked there.
    EXPECT_FALSE(live->picking().picked());
    for (const bool down : {false, true, false}) {
      ImGui::GetIO().MousePos = {440, 480};
      ImGui::GetIO().MouseDown[0] = down;
      live->input();
      live.draw();
    }
    EXPECT_TRUE(live->picking().picked());
    const glm::dvec3 at = live->picking().picked() ? live->picking().picked()->pick.position : glm::dvec3(0);
    ImGui::GetIO().MousePos = {panel.Min.x + 40, panel.Min.y + 20};
    live->input();
    live.draw();
    EXPECT_NE(ImGui::GetCurrentContext()->HoveredId, 0u) << "the choice of scenes";
    return std::tuple(panel.Min.x, panel.Max.x, panel.Max.y, at.x, at.y, at.z);
  };
  const auto once = panelOf(1);
  EXPECT_EQ(std::get<1>(once), 1280);
  EXPECT_EQ(std::get<2>(once), 800);
  EXPECT_EQ(panelOf(2), once);
  EXPECT_EQ(panelOf(1.5f), once);
}

}  // namespace
}  // namespace unshot
