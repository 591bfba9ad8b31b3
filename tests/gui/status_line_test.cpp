// The line at the bottom of the scene: where it stands, when it goes, and that nothing in it moves.
#include "viewer/panels/status_line.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <set>

#include "base/text.h"
#include "gui/support/gui_layout.h"
#include "support/live_viewer.h"
#include "viewer/panels/error_panel.h"

namespace unshot {
namespace {

using testing_support::LiveViewer;

LiveViewer::Options box(int width, int height) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 1000;
  options.width = width;
  options.height = height;
  options.pixels = false;
  return options;
}

const ImGuiWindow* status() {
  const ImGuiWindow* window = ImGui::FindWindowByName("status");
  return window && window->Active ? window : nullptr;
}

/// Where parts begin: a letter's left edge with more than a space's width of nothing before it. One within a
/// few pixels of `known` is the same: letters begin a little beside their place.
void addParts(const ImGuiWindow& window, std::set<int>& known) {
  const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
  const float em = window.CalcFontSize();
  float end = -1000;
  for (int k = 0; k + 3 < window.DrawList->VtxBuffer.Size; k += 4) {
    const ImDrawVert& v = window.DrawList->VtxBuffer[k];
    if (v.uv.x == white.x && v.uv.y == white.y) continue;
    const int x = static_cast<int>(v.pos.x);
    const auto near = known.lower_bound(x - 3);
    if (v.pos.x - end > 0.8f * em && (near == known.end() || *near > x + 3)) known.insert(x);
    end = window.DrawList->VtxBuffer[k + 2].pos.x;
  }
}

TEST(StatusLine, LiesAtTheBottomOfTheSceneAndGoesWithThePanel) {
  LiveViewer viewer(box(1280, 720));
  ASSERT_TRUE(viewer.untilPhase(SessionPhase::kConverged));
  viewer.draw();
  ASSERT_TRUE(status());
  EXPECT_EQ(status()->Rect().Max.y, 720);
  EXPECT_EQ(status()->Rect().Max.x, ImGui::FindWindowByName("panel")->Rect().Min.x);
  EXPECT_LT(status()->Size.y, 30);
  for (const auto& [action, on, off] :
       {std::array{"status", "on", "off"}, std::array{"panel", "on", "off"}}) {
    viewer->perform(action, off);
    viewer.draw();
    EXPECT_FALSE(status()) << action;
    viewer->perform(action, on);
    viewer.draw();
    EXPECT_TRUE(status()) << action;
  }
}

TEST(StatusLine, NothingMovesWhileFiguresChange) {
  LiveViewer viewer(box(1280, 720));
  std::set<int> seen;
  int frames = 0;
  ASSERT_TRUE(viewer.until([&] {
    // Vertices of the last frame, while it solves.
    if (viewer->state().phase == SessionPhase::kRunning && status()) {
      ++frames;
      addParts(*status(), seen);
    }
    return viewer->state().phase == SessionPhase::kConverged;
  }));
  EXPECT_GT(frames, 3);
  // Phase, unshot light, error, rows, frame, mode, renderer.
  EXPECT_LE(seen.size(), 7u) << testing::PrintToString(seen);
  EXPECT_GE(seen.size(), 6u) << testing::PrintToString(seen);
}

TEST(StatusLine, SaysNothingOfAnErrorOfWhichNothingIsKnown) {
  LiveViewer::Options options = box(1280, 720);
  options.script = "pause on\nstep\nwait shots 1\n";
  LiveViewer viewer(options);
  ASSERT_TRUE(viewer.until([&] { return viewer->scriptDone(); }));
  viewer.draw();
  ASSERT_TRUE(status());
  ASSERT_EQ(knownError(viewer->state()), "");
  EXPECT_EQ(errorInFront(viewer->state()), percentText(viewer->state().measures.unshot_fraction) + " unshot");
  std::set<int> parts;
  addParts(*status(), parts);
  EXPECT_LE(parts.size(), 5u);  // phase, unshot light, frame, mode, renderer
  EXPECT_GE(parts.size(), 4u);
}

// The estimate of an error below what noise hides is 0, and its interval goes up from there.
TEST(ErrorInFront, IsNeverZeroWhereNoiseHidesIt) {
  LaneState state;
  state.measures.unshot_fraction = 0.25;
  EXPECT_EQ(errorInFront(state), "25 % unshot");
  state.measures.bounds.upper = 0.02;
  EXPECT_EQ(errorInFront(state), "solver below 2 %");
  state.estimates.both = {0, 0, 0.1, 100};
  EXPECT_EQ(errorInFront(state), "error up to 12 %");
  state.measures.bounds.upper = 0.5;  // how bad it may be says nothing of how it is
  EXPECT_EQ(errorInFront(state), "error up to 60 %");
  state.measures.bounds.upper = 0.02;
  state.estimates.both.value = 0.05;
  EXPECT_EQ(errorInFront(state), "error about 7 %");
  state.estimates.total = {0.0597, 0, 0.169, 100};
  EXPECT_EQ(errorInFront(state), "error about 5.97 %");
  for (const double value : {0.0, 1e-5}) {
    state.estimates.total.value = value;
    EXPECT_EQ(errorInFront(state), "error up to 16.9 %");
  }
  state.estimates.total = {0, 0, 0, 100};
  EXPECT_EQ(errorInFront(state), "error about 0 %") << "nothing is reflected";
}

TEST(StatusLine, NamesWhatIsDoneBesideShooting) {
  SessionState state;
  state.phase = SessionPhase::kRunning;
  EXPECT_EQ(phaseLook(state).text, "Shooting");
  state.activity = "factorising";
  EXPECT_EQ(phaseLook(state).text, "Factorising");
  state.phase = SessionPhase::kConverged;
  EXPECT_EQ(phaseLook(state).text, "Converged");
  state.spare_work = true;
  EXPECT_EQ(phaseLook(state).text, "Converged, estimating");
  state.bounces_under_way = true;
  EXPECT_EQ(phaseLook(state).text, "Converged");
}

// Step by step, so that none of it is missed.
TEST(StatusLine, TheSolveTellsWhatItsModeDoes) {
  LiveViewer::Options options = box(320, 240);
  options.solve.elements = 100;
  options.solve.mode = "direct";
  options.script = "pause on\n";
  LiveViewer viewer(options);
  ASSERT_TRUE(viewer.untilPhase(SessionPhase::kPaused));
  std::set<std::string> told;
  ASSERT_TRUE(viewer.until([&] {
    if (!viewer->upToDate()) return false;
    told.insert(viewer->state().activity);
    if (viewer->state().phase == SessionPhase::kConverged) return true;
    viewer->step(1);
    return false;
  }));
  EXPECT_TRUE(told.contains("factorising")) << testing::PrintToString(told);
  EXPECT_EQ(viewer->state().activity, "");
}

/// The rectangle at the upper left corner of the line that is as high as a few pixels; 0: there is none.
float progressShown() {
  if (!status()) return 0;
  const ImVec2 corner = status()->Pos;
  const auto& vertices = status()->DrawList->VtxBuffer;
  for (int k = 0; k + 3 < vertices.Size; k += 4) {
    const ImVec2 from = vertices[k].pos, to = vertices[k + 2].pos;
    if (from.x == corner.x && from.y == corner.y && to.y - from.y < 4) return to.x - from.x;
  }
  return 0;
}

TEST(StatusLine, ALineGrowsAsTheSolveGoesOn) {
  LiveViewer::Options options = box(1280, 720);
  options.solve.elements = 10'000;
  LiveViewer viewer(options);
  std::set<float> widths;
  ASSERT_TRUE(viewer.until([&] {
    viewer.draw();
    const float width = progressShown(), whole = status() ? status()->Size.x : 0;
    EXPECT_LE(width, whole);
    if (viewer->state().phase == SessionPhase::kRunning && width > 0) widths.insert(width);
    return viewer->state().phase == SessionPhase::kConverged;
  }));
  EXPECT_GE(widths.size(), 3u);
  viewer.draw();
  EXPECT_EQ(progressShown(), 0) << "its time is over";
}

TEST(StatusLine, LeavesTheLastOutWhereItIsNarrow) {
  LiveViewer viewer(box(640, 360));
  ASSERT_TRUE(viewer.untilPhase(SessionPhase::kConverged));
  viewer.draw();
  ASSERT_TRUE(status());
  std::set<int> parts;
  addParts(*status(), parts);
  EXPECT_EQ(parts.size(), 5u);  // neither mode nor renderer
  EXPECT_LE(status()->ContentSize.x, status()->Size.x);
}

/// The letters of the line.
std::string textOf(const ImGuiWindow& window) {
  std::string out;
  for (const testing_support::Letter& letter :
       testing_support::Letters(*ImGui::GetIO().Fonts).of(*window.DrawList))
    out += letter.text;
  return out;
}

TEST(StatusLine, SaysWhereThePanelHasNoRoom) {
  LiveViewer viewer(box(900, 500));
  ASSERT_TRUE(viewer.untilPhase(SessionPhase::kConverged));
  const auto line = [&](const char* scale) {
    viewer->perform("scale", scale);
    for (int frame = 0; frame < 3; ++frame) viewer.draw();
    return status() ? textOf(*status()) : std::string();
  };
  EXPECT_EQ(line("1").find("Tab:"), std::string::npos) << "there is room";
  for (const char* scale : {"1.1", "2"}) {
    const std::string narrow = line(scale);
    EXPECT_NE(narrow.find("Tab:thepanel"), std::string::npos) << narrow;
    EXPECT_NE(narrow.find("unshot"), std::string::npos) << "figures beside it: " << narrow;
  }
  viewer->perform("panel", "");  // over the scene, and lifted again
  viewer->perform("panel", "");
  viewer.draw();
  EXPECT_TRUE(status()) << "as before";
  viewer->perform("panel", "off");
  viewer.draw();
  EXPECT_FALSE(status()) << "the line goes with the panel, which is not wanted then";
}

TEST(Panel, LiesOverTheSceneWhereItHasNoRoomBesideIt) {
  LiveViewer viewer(box(640, 360));
  ASSERT_TRUE(viewer.untilPhase(SessionPhase::kConverged));
  viewer->perform("scale", "2");
  const auto panel = [&] {
    for (int frame = 0; frame < 3; ++frame) viewer.draw();
    const ImGuiWindow* window = ImGui::FindWindowByName("panel");
    return window && window->Active ? window : nullptr;
  };
  const auto tab = [&] {
    viewer->key(258, false);  // GLFW_KEY_TAB
    return panel();
  };
  EXPECT_FALSE(panel());
  ASSERT_TRUE(tab());
  EXPECT_EQ(panel()->Rect().GetWidth(), 640) << "twice its width at scale 1";
  EXPECT_EQ(panel()->Rect().Max.x, 640);
  EXPECT_FALSE(status());
  EXPECT_FALSE(tab());
  EXPECT_TRUE(tab());
  // Beside the scene again once there is room.
  viewer->perform("scale", "1");
  viewer->perform("size", "1280x800");
  ASSERT_TRUE(panel());
  EXPECT_EQ(panel()->Rect().Max.x, 1280);
  EXPECT_TRUE(status());
  EXPECT_FALSE(tab());
  EXPECT_TRUE(tab());
}

}  // namespace
}  // namespace unshot
