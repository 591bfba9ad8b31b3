// Everything in the window that can be pressed is pressed, dragged or opened with the mouse, every row of
// every choice is chosen: none fails, breaks the layout or leaves the viewer in a state that it does not come
// out of.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "base/clock.h"
#include "export/image_files.h"
#include "gui/support/mouse.h"
#include "support/temp_folder.h"
#include "viewer/panels/sections.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using namespace testing_support;

class EveryControl : public testing::Test {
 protected:
  EveryControl() : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder_.path());  // for what is saved
    writePng("photograph.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
  }
  ~EveryControl() override { std::filesystem::current_path(before_); }

  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/two_patches.obj";
    options.solve.elements = 150;
    options.solve.error = 0.3;
    options.solve.form_factors = "hemicube";
    options.width = 1020;
    options.height = 2700;  // all of the panel is in it
    options.pixels = false;
    return options;
  }
  void act(const std::string& action, const std::string& argument = {}) {
    live_->perform(action, argument);
    ASSERT_FALSE(live_->error()) << action << " " << argument << ": " << live_->error()->fullText();
  }
  bool solved() {
    return live_.until([&] {
      const SessionPhase phase = live_->state().phase;
      // What has converged is paused again once Step has begun it anew.
      if (live_->upToDate() && phase == SessionPhase::kPaused) act("pause", "off");
      return live_->upToDate() && phase != SessionPhase::kLoading && phase != SessionPhase::kRunning &&
             phase != SessionPhase::kPaused && live_->scriptDone();
    });
  }
  void expectSound() {
    mouse_.frames(2);
    EXPECT_FALSE(live_->error()) << live_->error()->fullText();
    if (live_->error()) act("dismiss");
    const ImVec2 screen(static_cast<float>(live_.width()), static_cast<float>(live_.height()));
    std::set<std::string> problems = LayoutCheck(screen).problems();
    if (!problems.empty()) {  // a window is as large as a text that has just come from the next frame on
      mouse_.frames(2);
      problems = LayoutCheck(screen).problems();
    }
    for (const std::string& problem : problems) ADD_FAILURE() << problem;
  }

  /// Where the first view has something.
  void pickAgain() {
    if (live_->picking().picked()) return;
    act("projection", "perspective");
    act("frame");
    mouse_.rest();
    for (double y = 0.3; y < 0.7 && !live_->picking().picked(); y += 0.02) {
      live_->pick({0.5, y});
      mouse_.frames(2);
    }
    ASSERT_TRUE(live_->picking().picked());
  }

  /// What a control may have closed, opened or started is as it was before.
  virtual void restore() = 0;

  ImGuiWindow* popup() const {
    const auto& stack = ImGui::GetCurrentContext()->OpenPopupStack;
    return stack.Size > 0 ? stack[0].Window : nullptr;
  }
  void closePopup() {
    for (int k = 0; k < 3 && popup(); ++k) mouse_.click({3, static_cast<float>(live_.height()) - 3});
    EXPECT_FALSE(popup()) << "does not close";
  }
  bool isAt(ImGuiID id, const ImVec2& at) {
    mouse_.to(at);
    return ImGui::GetCurrentContext()->HoveredId == id;
  }
  /// Where it is now, in the column where it was: what is above it may have another height.
  std::optional<ImVec2> find(ImGuiID id, const ImVec2& at) {
    for (float by = 0; by < 260; by += 4) {
      for (const float sign : {1.0f, -1.0f}) {
        if (isAt(id, {at.x, at.y + sign * by})) return ImGui::GetIO().MousePos;
      }
    }
    return std::nullopt;
  }

  /// Each row of the choice that is open, and opens it again for the next.
  void chooseEach(ImGuiID id, ImVec2 at) {
    const auto rows = mouse_.itemsIn(*popup(), {0.3f});
    EXPECT_GE(rows.size(), 1u) << "a choice without rows";
    for (const auto& row : rows) {
      if (!popup()) mouse_.click(at);
      ASSERT_TRUE(popup()) << "does not open again";
      mouse_.click(row.second);
      ++rows_;
      closePopup();
      live_->giveUpLoading();
      expectSound();
      restore();
      const auto again = find(id, at);
      ASSERT_TRUE(again) << "gone";
      at = *again;
    }
  }

  /// Clicks it, and opens or drags it, each as it takes.
  void use(ImGuiID id, const ImVec2& found) {
    SCOPED_TRACE("the control found at " + std::to_string(found.x) + ", " + std::to_string(found.y));
    const auto at = find(id, found);
    if (!at) return;
    ++used_;
    mouse_.click(*at);
    expectSound();
    if (ImGuiWindow* opened = popup()) {
      if (std::string(opened->Name).starts_with("##Combo")) return chooseEach(id, *at);
      mouse_.drag(opened->Rect().GetCenter());
      closePopup();
    } else if (isAt(id, *at)) {
      // A switch is as it was after a second click; a slider is pulled.
      mouse_.press(*at);
      for (const float by : {-10.0f, 15.0f, 0.0f}) mouse_.to({at->x + by, at->y});
      mouse_.letGo();
    }
    expectSound();
    restore();
  }

  void useAll(const ImRect& box, std::initializer_list<float> across) {
    const double begin = cpuSeconds();
    const auto items = mouse_.itemsIn(box, across);
    const double found = cpuSeconds();
    for (const auto& [id, at] : items) {
      use(id, at);
      if (HasFatalFailure()) return;
    }
    std::printf("[ MEASURED ] %zu controls, CPU %.1f s to find and %.1f s to use\n", items.size(),
                found - begin, cpuSeconds() - found);
  }

  TempFolder folder_;
  LiveViewer live_{options()};
  Mouse mouse_{live_};
  int used_ = 0, rows_ = 0;

 private:
  std::filesystem::path before_;
};

class EveryControlOfThePanel : public EveryControl {
 protected:
  void restore() override {
    ViewerState& ui = live_->ui();
    ui.prompt.close();
    ui.help = false;
    ui.settings.view.display = "false-radiosity";
    ui.settings.histogram = ui.materials = ui.notes = ui.left_out = true;
    TeachingChoices& choices = live_->teaching().choices;
    choices.lecture = choices.hemicube = false;
    if (live_->state().rival) act("race", "off");
    const SolveOptions& options = ui.options;
    if (options.elements != 150u) act("elements", "150");
    if (options.error != 0.3) act("error", "0.3");
    if (options.hemicube_resolution != 0) act("hemicube", "0");
    if (options.form_factors != "hemicube") act("form-factors", "hemicube");
    if (options.mode != "auto") act("mode", "auto");
    if (options.emit_front_only) act("emit", "both");
    if (options.sky) act("sky", "auto");
    if (!options.do_anyway.empty()) act("do-all", "off");
    if (live_->state().phase == SessionPhase::kPaused) act("pause", "off");
    ASSERT_TRUE(solved());
    pickAgain();
    if (live_->picking().pinned().empty()) act("pin-probe");
    if (!live_->referencePicture()) act("reference-picture", "photograph.png");
    live_->dismissNotices();
    ASSERT_TRUE(live_.until([&] { return live_->scriptDone(); }));
    mouse_.frames(2);
  }
};

TEST_F(EveryControlOfThePanel, CanBeUsed) {
  ASSERT_TRUE(solved());
  openSections(*live_);
  act("complete-bounces");
  restore();
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  ASSERT_EQ(panel->ScrollMax.y, 0) << "make the window of this test higher";
  const ImRect sections = panel->InnerRect, whole = ImGui::FindWindowByName("panel")->Rect();
  useAll({whole.Min, {whole.Max.x, sections.Min.y}}, {0.1f, 0.35f, 0.6f, 0.75f, 0.93f});
  useAll({sections.Min, {sections.Max.x, sections.Min.y + panel->ContentSize.y}},
         {0.07f, 0.3f, 0.5f, 0.7f, 0.93f});
  std::printf("[ MEASURED ] %d controls, %d rows of choices\n", used_, rows_);
  EXPECT_GT(used_, 60);
  EXPECT_GT(rows_, 60);
  // It comes out of all of it.
  act("restart");
  EXPECT_TRUE(solved());
  EXPECT_EQ(live_->state().phase, SessionPhase::kConverged);
}

class EveryControlOfTheLecture : public EveryControl {
 protected:
  void restore() override {
    TeachingChoices& choices = live_->teaching().choices;
    choices.lecture = true;
    choices.page = page_;
    choices.allow_divergence = true;
    live_->ui().settings.view.display = "radiosity";
    live_->ui().settings.view.light = {};
    if (live_->state().phase == SessionPhase::kPaused) act("pause", "off");
    ASSERT_TRUE(solved());
    pickAgain();
    ASSERT_TRUE(live_.until([&] {
      const bool known = page_ != LecturePage::kEquation || live_->teaching().patch();
      return live_->nextFrame(0) > 1e30 && live_->teaching().settled() && known;
    }));
    mouse_.frames(2);
  }
  LecturePage page_ = LecturePage::kMatrix;
};

TEST_F(EveryControlOfTheLecture, CanBeUsed) {
  ASSERT_TRUE(solved());
  act("size", "640x900");
  act("complete-bounces");
  ASSERT_TRUE(solved());
  for (const LecturePageRow& row : lecturePages()) {
    SCOPED_TRACE(row.info.key);
    page_ = row.page;
    restore();
    const ImGuiWindow* lecture = ImGui::FindWindowByName("lecture");
    ASSERT_TRUE(lecture && lecture->Active);
    useAll(lecture->Rect(), {0.06f, 0.2f, 0.4f, 0.6f, 0.97f});
  }
  std::printf("[ MEASURED ] %d controls, %d rows of choices\n", used_, rows_);
  EXPECT_GT(used_, 25);
}

class EveryControlOverTheScene : public EveryControl {
 protected:
  void restore() override {
    live_->perform("hemicube-view", "on");
    ASSERT_TRUE(live_.until([&] { return live_->nextFrame(0) > 1e30 && live_->teaching().settled(); }));
    mouse_.frames(2);
  }
  /// Of the window of this name.
  void press(const char* window, ImGuiID id) {
    mouse_.frames(3);
    const ImGuiWindow* found = ImGui::FindWindowByName(window);
    ASSERT_TRUE(found && found->Active && !found->Hidden) << "no window " << window;
    const auto items = mouse_.itemsIn(found->Rect(), {0.06f, 0.2f, 0.35f, 0.5f, 0.65f, 0.8f, 0.9f, 0.96f});
    const auto item = items.find(id);
    ASSERT_NE(item, items.end()) << "not in the window " << window;
    mouse_.click(item->second);
  }
  void press(const char* window, const std::string& label) {
    SCOPED_TRACE(label);
    mouse_.frames(3);
    ASSERT_TRUE(ImGui::FindWindowByName(window)) << "no window " << window;
    press(window, idOf(label, ImGui::FindWindowByName(window)->ID));
  }
};

TEST_F(EveryControlOverTheScene, CanBeUsed) {
  ASSERT_TRUE(solved());
  act("size", "900x600");
  live_->perform("display", "one");
  live_->perform("display", "two");
  press("message", "###close");  // Next
  ASSERT_TRUE(live_->error());
  press("message", "###close");
  EXPECT_FALSE(live_->error());
  live_->notice("written: something");
  press("notice", "\u00d7");
  EXPECT_TRUE(live_->messages().lines().empty());
  restore();
  const ImGuiWindow* hemicube = ImGui::FindWindowByName("hemicube");
  ASSERT_TRUE(hemicube && hemicube->Active);
  useAll(hemicube->Rect(), {0.3f, 0.95f});
  EXPECT_GE(rows_, 5);
  act("hemicube-view", "off");
  act("actions", "next-display");
  mouse_.frames(4);
  const std::string shown = live_->settings().view.display;
  const ImGuiWindow* rows = childOf("prompt", "rows");
  ASSERT_TRUE(rows);
  mouse_.click({rows->Pos.x + 30, rows->Pos.y + 8});
  EXPECT_NE(live_->settings().view.display, shown);
  EXPECT_FALSE(live_->ui().prompt.open());
}

TEST_F(EveryControlOverTheScene, AChangedSceneIsReadAgainOrKept) {
  for (const char* name : {"cornell_box.obj", "cornell_box.mtl"})
    std::filesystem::copy_file(std::string(UNSHOT_SOURCE_DIR) + "/assets/" + name, folder_ / name);
  act("size", "900x600");
  act("watch", "on");
  act("open", folder_ / "cornell_box.obj");
  ASSERT_TRUE(live_.until([&] {
    return live_->state().facts && live_->state().facts->scene_path.string() == folder_ / "cornell_box.obj";
  }));
  ASSERT_TRUE(solved());
  const auto change = [&] {
    std::ofstream(folder_ / "cornell_box.obj", std::ios::app) << "# once more\n";
    return live_.until([&] { return live_->sceneChanged(); });
  };
  const std::uint64_t epoch = live_->state().epoch;
  ASSERT_TRUE(change());
  press("changed", "Keep");
  EXPECT_FALSE(live_->sceneChanged());
  EXPECT_EQ(live_->state().epoch, epoch);
  ASSERT_TRUE(change());
  press("changed", "Reload");
  EXPECT_FALSE(live_->sceneChanged());
  EXPECT_TRUE(live_.until([&] { return live_->state().epoch > epoch; }));
  ASSERT_TRUE(solved());
  const int first = 0;
  // What takes its time is given up, and the scene before stays.
  act("elements", "1000000");
  ASSERT_TRUE(live_.until([&] {
    const ImGuiWindow* tasks = ImGui::FindWindowByName("tasks");
    return tasks && tasks->Active;
  }));
  press("tasks", idOf("Give up", ImHashData(&first, sizeof first, ImGui::FindWindowByName("tasks")->ID)));
  EXPECT_TRUE(solved());
  EXPECT_LT(live_->state().facts->elements, 1000u);
}

}  // namespace
}  // namespace unshot
