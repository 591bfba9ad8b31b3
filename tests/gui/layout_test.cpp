// Nothing of the window lies over anything else, is cut off or goes beyond the screen: at several sizes and
// scales, with every section and overlay open.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>

#include "export/image_files.h"
#include "gui/support/gui_bench.h"
#include "gui/support/gui_layout.h"
#include "render/display_modes.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/panels/widgets.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using testing_support::GuiBench;
using testing_support::LayoutCheck;
using testing_support::Letter;
using testing_support::Letters;
using testing_support::LiveViewer;
using testing_support::TempFolder;

// A check that finds nothing may look at nothing.
TEST(LayoutCheck, FindsWhatIsWrong) {
  GuiBench bench(640, 360);
  const ImVec2 screen(640, 360);
  const auto window = [](const char* name, const ImVec2& at, const char* text, float shift) {
    ImGui::SetNextWindowPos(at);
    ImGui::SetNextWindowSize({100, 60});
    ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextUnformatted(text);
    if (shift > 0) {
      ImGui::SameLine(shift);
      ImGui::TextUnformatted(text);
    }
    ImGui::End();
  };
  const auto content = [&] {
    window("one", {50, 50}, "some text that is far too long for the window", 0);
    window("other", {100, 80}, "words", 20);
    window("away", {screen.x - 50, 200}, "short", 0);
  };
  bench.layOut(content);  // a window does not know yet how much is in it
  bench.layOut(content);
  std::string all;
  for (const std::string& problem : LayoutCheck(screen).problems()) all += problem + "\n";
  EXPECT_NE(all.find("window 'one' is too narrow"), std::string::npos) << all;
  EXPECT_NE(all.find("window 'one' and window 'other' lie over each other"), std::string::npos) << all;
  EXPECT_NE(all.find("window 'away' goes beyond the screen"), std::string::npos) << all;
  EXPECT_NE(all.find(" under "), std::string::npos) << all;
}

/// Whether a line ends in a point or comma with a digit on the next one.
bool tearsANumberApart(const ImDrawList& list) {
  const std::vector<Letter> letters = Letters(*ImGui::GetIO().Fonts).of(list);
  for (std::size_t k = 0; k + 1 < letters.size(); ++k) {
    const bool mark = letters[k].text == "." || letters[k].text == ",";
    const bool digit = std::isdigit(static_cast<unsigned char>(letters[k + 1].text[0])) != 0;
    if (mark && digit && letters[k + 1].box.Min.x < letters[k].box.Min.x) return true;
  }
  return false;
}

TEST(Wrapped, TearsNoNumberApart) {
  GuiBench bench(640, 360);
  for (int width = 80; width < 400; width += 7) {
    const auto content = [&] {
      ImGui::SetNextWindowPos({0, 0});
      ImGui::SetNextWindowSize({static_cast<float>(width), 300});
      ImGui::Begin("text", nullptr, ImGuiWindowFlags_NoSavedSettings);
      wrapped("In full M has 1,234 entries and 0.0638 MB\nkept of K: 0.0638");
      ImGui::End();
    };
    bench.layOut(content);
    bench.layOut(content);
    EXPECT_FALSE(tearsANumberApart(*ImGui::FindWindowByName("text")->DrawList)) << width;
  }
}

TEST(HemicubePanel, TearsNoNumberApart) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 300;
  options.script = "wait converged\npick 0.45,0.6\nhemicube-view on\n";
  options.width = 640;
  options.height = 360;
  LiveViewer viewer(options);
  ASSERT_TRUE(viewer.until([&] { return viewer->scriptDone() && viewer->teaching().look(); }));
  for (int frame = 0; frame < 3; ++frame) viewer.draw();
  const ImGuiWindow* window = ImGui::FindWindowByName("hemicube");
  ASSERT_TRUE(window && window->Active);
  EXPECT_GT(viewer->teaching().shares().back(), 0);
  EXPECT_FALSE(tearsANumberApart(*window->DrawList));
}

/// A state of the window: what is done to get there, and to leave it.
struct Step {
  std::string action, argument;
};
struct State {
  std::string name;
  std::vector<Step> enter, leave;
  std::string shows = {};  ///< a window that is there then
};

struct WindowSize {
  int width, height;
  double scale;
};

class Layout : public testing::TestWithParam<WindowSize> {
 protected:
  void SetUp() override {
    writePng(folder_ / "photograph.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
    ASSERT_TRUE(viewer_.untilPhase(SessionPhase::kConverged));
    viewer_->perform("size", std::to_string(GetParam().width) + "x" + std::to_string(GetParam().height));
    viewer_->setScale(GetParam().scale);
    viewer_.draw();
    // Closed at first.
    if (ImGuiWindow* sections = scrolled())
      sections->StateStorage.SetInt(ImHashStr("###messages", 0, sections->ID), 1);
    ASSERT_TRUE(viewer_.until([&] { return viewer_->nextFrame(0) > 1e30; }));
  }

  std::vector<State> states() const {
    const Step off{"dismiss", ""};
    const Step message{"open", "a_scene_that_is_nowhere_in_any_folder_at_all.obj"};
    std::vector<State> out = {
        {"at rest", {}, {}},
        {"help", {{"help", "on"}}, {{"help", "off"}}},
        {"the hint", {{"show the hint", ""}}, {{"hide the hint", ""}}, "notice"},
        {"a file written", {{"screenshot", long_name_}}, {{"dismiss-notices", ""}}, "notice"},
        {"all actions", {{"actions", ""}}, {off}},
        {"an action", {{"actions", "wipe 2"}}, {off}},
        {"no action", {{"actions", "zebra"}}, {off}},
        {"scenes", {{"browse", std::string(UNSHOT_SOURCE_DIR) + "/tests/data"}}, {off}},
        {"picked", {{"pick", "0.45,0.6"}}, {}},
        {"hemicube", {{"hemicube-view", "on"}}, {}},
        {"hemicube and legend", {{"display", "form-factors"}}, {{"display", "radiosity"}}},
        {"hemicube and scale", {{"display", "difference"}}, {}},
        {"hemicube and colours", {{"display", "normals"}}, {}},
        {"hemicube and other colours", {{"display", "sides"}}, {{"display", "radiosity"}}},
        {"hemicube and bounces", {{"complete-bounces", ""}, {"bounces", "2"}}, {{"bounces", "all"}}},
        {"hemicube and a part of the light", {{"radiosity", "off"}}, {}},
        {"hemicube, legend and a part of the light",
         {{"display", "false-irradiance"}},
         {{"radiosity", "on"}, {"display", "radiosity"}}},
        {"lecture's matrix", {{"complete-bounces", ""}, {"lecture-page", "matrix"}}, {}},
        {"lecture's divergence",
         {{"allow-divergence", "on"}, {"matrix-reflectance", "1.2"}},
         {{"allow-divergence", "off"}}},
        {"lecture's equation", {{"lecture-page", "equation"}, {"pick", "0.5,0.5"}}, {}},
        {"lecture's shots", {{"lecture-page", "shots"}}, {}},
        {"lecture's effects", {{"lecture-page", "effects"}}, {{"lecture", "off"}, {"hemicube-view", "off"}}},
        {"probes",
         {{"pin-probe", ""}, {"pick", "0.5,0.8"}, {"pin-probe", ""}},
         {{"clear-probes", ""}, {"unpick", ""}}},
        {"materials", {{"materials", "on"}, {"reflectance", "red 0.1,0.2,0.7"}}, {{"materials", "off"}}},
        {"notes", {{"notes", "on"}}, {{"notes", "off"}}},
        {"what is left out", {{"left-out", "on"}}, {{"left-out", "off"}}},
        {"histogram", {{"histogram", "on"}}, {{"histogram", "off"}}},
        {"bounces", {{"bounces", "2"}}, {{"bounces", "all"}}},
        {"direct light", {{"radiosity", "off"}}, {{"radiosity", "on"}}},
        {"remembered",
         {{"remember", ""}, {"display", "difference"}},
         {{"forget", ""}, {"display", "radiosity"}}},
        {"wipe", {{"reference-picture", folder_ / "photograph.png"}, {"wipe", "0.5"}}, {}},
        {"wiped away", {{"wipe", "0"}}, {}},
        {"wipe and unshot light", {{"wipe", "0.5"}, {"display", "unshot"}}, {}, "reference picture"},
        {"wipe, hemicube and unshot light", {{"hemicube-view", "on"}}, {{"display", "radiosity"}}},
        {"wipe and a part of the light", {{"radiosity", "off"}}, {}},
        {"picture's difference", {{"picture-difference", "on"}}, {}, "reference picture"},
        {"picture's difference and all light",
         {{"radiosity", "on"}},
         {{"hemicube-view", "off"}, {"picture-difference", "off"}}},
        {"wipe and a file written", {{"screenshot", long_name_}}, {{"dismiss-notices", ""}}, "notice"},
        {"wipe and a scene that changed",
         {{"touch the scene", ""}},
         {{"dismiss", ""}, {"forget-picture", ""}},
         "changed"},
        {"a scene that changed", {{"touch the scene", ""}}, {}, "changed"},
        {"a message and a scene that changed", {message}, {off, off}, "message"},
        {"a message", {message}, {}, "message"},
        {"a message and all actions", {{"actions", ""}}, {off, off}, "prompt"},
        {"race", {{"race", "jacobi"}}, {}, "race-left"},
        {"race and a scene that changed", {{"touch the scene", ""}}, {off}, "changed"},
        {"race and a file written",
         {{"screenshot", long_name_}},
         {{"dismiss-notices", ""}, {"race", "off"}},
         "notice"},
        {"under way", {{"mesh", "300000"}}, {}, "tasks"},
        {"a running solve", {{"solve", "30000"}}, {{"elements", "300"}}},
    };
    for (const char* page : {"matrix", "equation", "shots", "effects"})
      out.push_back({page, {{"lecture-page", page}}, {{"lecture", "off"}}});
    for (const DisplayMode& mode : displayModes())
      out.push_back({"display " + std::string(mode.info.key),
                     {{"display", std::string(mode.info.key)}},
                     {{"display", "radiosity"}}});
    // Over the scene in small windows.
    out.insert(out.end(), {
                              {"the panel by Tab", {{"panel", ""}}, {}},
                              {"the panel by Tab again", {{"panel", ""}}, {{"panel", "on"}}},
                              {"the lecture under the panel",
                               {{"panel", ""}, {"panel", "on"}, {"lecture", ""}},
                               {{"lecture", "off"}, {"panel", "on"}},
                               "lecture"},
                              {"the hemicube under the panel",
                               {{"pick", "0.45,0.6"}, {"panel", ""}, {"panel", "on"}, {"hemicube-view", ""}},
                               {{"hemicube-view", "off"}, {"unpick", ""}, {"panel", "on"}},
                               "hemicube"},
                              {"the panel and a message", {message}, {off}, "message"},
                          });
    return out;
  }

  void perform(const std::vector<Step>& steps) {
    for (const Step& step : steps) {
      begin(step);
      ASSERT_TRUE(viewer_.until([&] { return arrived(step); })) << step.action;
    }
  }

  void begin(const Step& step) {
    if (step.action == "show the hint" || step.action == "hide the hint") {
      viewer_->ui().hint = step.action == "show the hint";
    } else if (step.action == "touch the scene") {
      viewer_->perform("watch", "on");
      std::ofstream(scene_, std::ios::app) << "# once more\n";
    } else {
      const bool half_way = step.action == "mesh" || step.action == "solve";
      viewer_->perform(half_way ? "elements" : step.action, step.argument);
    }
  }

  /// What is picked, opened or solved anew takes its time.
  bool arrived(const Step& step) const {
    const SessionState& state = viewer_->state();
    if (step.action == "mesh") return shown("tasks");
    if (step.action == "solve") return viewer_->upToDate() && state.phase == SessionPhase::kRunning;
    if (step.action == "touch the scene" && !viewer_->sceneChanged()) return false;
    if (step.action == "open" && !viewer_->error()) return false;
    if (step.action == "race" && state.rival.has_value() != (step.argument != "off")) return false;
    return state.phase != SessionPhase::kLoading && state.phase != SessionPhase::kRunning &&
           viewer_->scriptDone();
  }

  /// Of the frame, with the panel at every place that it can be scrolled to.
  std::set<std::string> problems() {
    std::set<std::string> out;
    const ImVec2 screen(static_cast<float>(viewer_.width()), static_cast<float>(viewer_.height()));
    for (float at = 0;;) {
      if (ImGuiWindow* sections = scrolled()) ImGui::SetScrollY(sections, at);
      for (int frame = 0; frame < 3; ++frame) viewer_.draw();
      out.merge(LayoutCheck(screen).problems());
      const ImGuiWindow* sections = scrolled();
      if (!sections || at >= sections->ScrollMax.y) return out;
      at = std::min(at + 0.7f * sections->InnerRect.GetHeight(), sections->ScrollMax.y);
    }
  }

  static bool shown(const std::string& name) {
    const ImGuiWindow* window = ImGui::FindWindowByName(name.c_str());
    return window && window->Active && !window->Hidden;
  }

  const TempFolder folder_;
  const std::string long_name_ = folder_ /
                                 "a_picture_of_the_window_with_a_name_that_is_longer_than_any_"
                                 "scene_is_wide_where_it_stands_beside_the_panel.png";
  const std::string scene_ = folder_ / "cornell_box.obj";
  mutable LiveViewer viewer_{options()};

 private:
  LiveViewer::Options options() const {
    const std::filesystem::path assets = std::string(UNSHOT_SOURCE_DIR) + "/assets";
    for (const char* name : {"cornell_box.obj", "cornell_box.mtl"})
      std::filesystem::copy_file(assets / name, folder_ / name);
    LiveViewer::Options options;
    options.scene = scene_;
    options.solve.elements = 300;
    options.width = 640;
    options.height = 360;
    options.pixels = false;
    return options;
  }
  static ImGuiWindow* scrolled() {
    for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
      if (window->Active && (std::string(window->Name).starts_with("panel/sections") ||
                             std::string(window->Name).starts_with("lecture/page")))
        return window;
    }
    return nullptr;
  }
};

TEST_P(Layout, NothingLiesOverAnythingElseOrIsCutOff) {
  for (const State& state : states()) {
    SCOPED_TRACE(state.name);
    perform(state.enter);
    if (HasFatalFailure()) return;
    EXPECT_EQ(viewer_->error().has_value(), state.name.find("a message") != std::string::npos);
    // Where there is room for both.
    if (!state.shows.empty() && GetParam().height / GetParam().scale > 300) {
      for (int frame = 0; frame < 3; ++frame) viewer_.draw();
      EXPECT_TRUE(shown(state.shows)) << "there is nothing to look at";
    }
    for (const std::string& problem : problems())
      ADD_FAILURE() << problem << testing::PrintToString(viewer_->messages().lines());
    perform(state.leave);
  }
}

INSTANTIATE_TEST_SUITE_P(Gui, Layout,
                         testing::Values(WindowSize{640, 360, 1}, WindowSize{960, 540, 1},
                                         WindowSize{1280, 800, 1}, WindowSize{640, 360, 2},
                                         WindowSize{960, 540, 2}, WindowSize{1280, 800, 2}),
                         [](const auto& row) {
                           return std::to_string(row.param.width) + "x" + std::to_string(row.param.height) +
                                  "At" + std::to_string(static_cast<int>(row.param.scale));
                         });

}  // namespace
}  // namespace unshot
