// Every slider is dragged and every colour picker opened, with the mouse as a person has it, and the value
// behind it has changed; what the mouse rests on says what it is, within the window.
#include <gmock/gmock.h>
#include <imgui_internal.h>

#include <functional>
#include <map>
#include <set>

#include "export/image_files.h"
#include "gui/support/mouse.h"
#include "gui/support/panel.h"
#include "gui/support/screen.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

using namespace testing_support;

class Controls : public testing::Test {
 protected:
  Controls() : live_(options()) {
    EXPECT_TRUE(live_.untilPhase(SessionPhase::kConverged));
    openSections(*live_);
    rest();
  }

  static LiveViewer::Options options() {
    LiveViewer::Options options;
    options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
    options.solve.elements = 200;
    options.solve.error = 0.1;
    options.width = 1020;
    options.height = 2000;  // all of the panel is in it: what is not cannot be clicked
    options.pixels = false;
    return options;
  }
  void act(const std::string& action, const std::string& argument = {}) {
    live_->perform(action, argument);
    ASSERT_FALSE(live_->error()) << live_->error()->fullText();
    rest();
  }
  void rest() { mouse_.rest(); }
  void frames(int count = 2) { mouse_.frames(count); }
  void mouseTo(const ImVec2& at) { mouse_.to(at); }
  void click(const ImVec2& at) { mouse_.click(at); }
  void drag(const ImVec2& at) { mouse_.drag(at); }
  std::map<ImGuiID, ImVec2> itemsIn(const ImGuiWindow& window, std::initializer_list<float> across) {
    return mouse_.itemsIn(window, across);
  }

  /// Drags the slider and sees that the value has become another one.
  void expectDrags(const std::map<ImGuiID, ImVec2>& items, const ImGuiWindow& window,
                   const std::string& label, const std::function<double()>& value) {
    SCOPED_TRACE(label);
    const auto item = items.find(idOf(label, window.ID));
    ASSERT_NE(item, items.end()) << "the mouse finds nothing of this name";
    const double before = value();
    drag(item->second);
    EXPECT_NE(value(), before);
    EXPECT_FALSE(live_->error());
    rest();
  }

  LiveViewer live_;
  Mouse mouse_{live_};
};

TEST_F(Controls, SlidersOfThePanelChangeWhatTheyStandFor) {
  const TempFolder folder;
  writePng(folder / "photograph.png", Image8{2, 1, {255, 128, 0, 0, 128, 255}});
  act("reference-picture", folder / "photograph.png");
  act("materials", "on");
  act("complete-bounces");
  ASSERT_TRUE(live_.until([&] { return !live_->state().bounces_under_way; }));
  const auto& materials = live_->edits().materials();
  while (!materials[live_->ui().material].emits()) ++live_->ui().material;
  frames();
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  ASSERT_EQ(panel->ScrollMax.y, 0) << "make the window of this test higher";
  const auto items = itemsIn(*panel, {0.6f});
  expectDrags(items, *panel, "##exposure", [&] { return live_->settings().view.exposure_ev; });
  expectDrags(items, *panel, "##angle", [&] { return live_->camera().fov_deg; });
  expectDrags(items, *panel, "##speed", [&] { return live_->navigator().speedFactor(); });
  expectDrags(items, *panel, "##wipe", [&] { return live_->ui().wipe; });
  expectDrags(items, *panel, "##bounces-shown",
              [&] { return static_cast<double>(live_->settings().view.light.bounces.value_or(0)); });
  expectDrags(items, *panel, "##strength", [&] {
    const glm::dvec3 e = live_->edits().materials()[live_->ui().material].emission;
    return e.x + e.y + e.z;
  });
}

TEST_F(Controls, ABounceIsChosenByItself) {
  act("complete-bounces");
  ASSERT_TRUE(live_.until([&] { return !live_->state().bounces_under_way; }));
  frames();
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  const auto items = itemsIn(*panel, {0.1f, 0.6f});
  const auto chart = items.find(idOf("##bounces", panel->ID)),
             box = items.find(idOf("This bounce alone", panel->ID));
  ASSERT_TRUE(chart != items.end());
  ASSERT_TRUE(box != items.end());
  const LightChoice& light = live_->settings().view.light;
  click(box->second);
  EXPECT_TRUE(light.all()) << "there is none to be alone";
  act("bounces", "2");
  click(box->second);
  EXPECT_TRUE(light.oneBounce());
  EXPECT_EQ(light.bounces, 2u);
  click(box->second);
  EXPECT_FALSE(light.oneBounce());
  EXPECT_EQ(light.bounces, 2u);
  // On the bar of the first bounce: the scale's figures are 3.4 letters' heights wide.
  const float left = panel->ContentRegionRect.Min.x + 3.4f * ImGui::GetFontSize();
  const auto bars = static_cast<float>(live_->state().snapshot->bounce_light->power.size());
  const float slot = std::min((panel->ContentRegionRect.Max.x - left) / bars, 2.4f * ImGui::GetFontSize());
  const ImVec2 first(left + 1.5f * slot, chart->second.y);
  ImGui::GetIO().KeyShift = true;
  click(first);
  EXPECT_TRUE(light.oneBounce());
  EXPECT_EQ(light.bounces, 1u);
  ImGui::GetIO().KeyShift = false;
  click(first);
  EXPECT_FALSE(light.oneBounce());
  EXPECT_EQ(light.bounces, 1u);
  click(first);
  EXPECT_TRUE(light.all()) << "once more is all light again";
}

TEST_F(Controls, SlidersOfTheLectureChangeWhatTheyStandFor) {
  act("complete-bounces");
  act("lecture-page", "matrix");
  act("allow-divergence", "on");
  act("matrix-reflectance", "1");
  ASSERT_TRUE(live_.until([&] { return live_->teaching().settled() && live_->teaching().insight(); }));
  rest();
  frames(3);
  const ImGuiWindow* page = childOf("lecture", "page");
  ASSERT_TRUE(page);
  const auto items = itemsIn(*page, {0.1f, 0.55f});
  expectDrags(items, *page, "##power", [&] { return static_cast<double>(live_->teaching().choices.power); });
  expectDrags(items, *page, "##reflectance", [&] { return live_->teaching().choices.reflectance; });
  act("matrix-factor", "1");
  frames(3);
  expectDrags(itemsIn(*page, {0.55f}), *page, "##factor", [&] { return live_->teaching().choices.factor; });
}

TEST_F(Controls, ColourPickersOpenAndChangeTheirMaterial) {
  act("materials", "on");
  const auto& materials = live_->edits().materials();
  while (!materials[live_->ui().material].emits()) ++live_->ui().material;
  frames();
  const std::size_t chosen = live_->ui().material;
  for (const char* label : {"##reflects", "##colour"}) {
    SCOPED_TRACE(label);
    const ImGuiWindow* panel = childOf("panel", "sections");
    ASSERT_TRUE(panel);
    const auto items = itemsIn(*panel, {0.96f, 0.9f});
    const auto button = items.find(idOf(label + std::string("/##ColorButton"), panel->ID));
    ASSERT_NE(button, items.end()) << "no button with the colour";
    click(button->second);
    const ImGuiContext& gui = *ImGui::GetCurrentContext();
    ASSERT_EQ(gui.OpenPopupStack.Size, 1) << "no picker opens";
    const ImGuiWindow* picker = gui.OpenPopupStack[0].Window;
    ASSERT_TRUE(picker && picker->Active);
    const ImRect box = picker->Rect();
    EXPECT_GE(box.Min.x, 0);
    EXPECT_GE(box.Min.y, 0);
    EXPECT_LE(box.Max.x, static_cast<float>(live_.width()));
    EXPECT_LE(box.Max.y, static_cast<float>(live_.height()));
    const Material before = live_->edits().materials()[chosen];
    // Somewhere in the triangle within the wheel.
    drag({box.Min.x + 0.4f * std::min(box.GetWidth(), box.GetHeight()),
          box.Min.y + 0.45f * std::min(box.GetWidth(), box.GetHeight())});
    EXPECT_NE(live_->edits().materials()[chosen], before);
    click({5, static_cast<float>(live_.height()) - 5});  // beside it
    EXPECT_EQ(gui.OpenPopupStack.Size, 0) << "does not close";
    rest();
  }
}

// Keys and clicks are for the list alone while one is open.
TEST_F(Controls, AnOpenListHasTheKeyboardAndTheMouse) {
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  const auto items = itemsIn(*panel, {0.6f});
  const auto show = items.find(idOf("##display", panel->ID));
  ASSERT_TRUE(show != items.end());
  const auto open = [&] { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup); };
  click(show->second);
  ASSERT_TRUE(open());
  live_->key('M', false);
  frames();
  EXPECT_EQ(live_->settings().view.display, "radiosity");
  EXPECT_TRUE(open());
  live_->key(256, false);  // GLFW_KEY_ESCAPE
  live_->key('M', false);  // before the next frame: Esc is not forgotten
  frames();
  EXPECT_FALSE(open());
  click(show->second);
  ASSERT_TRUE(open());
  click({300, 1000});
  EXPECT_FALSE(open());
  EXPECT_FALSE(live_->picking().picked()) << "the click was for the list";
  click({300, 1000});
  EXPECT_TRUE(live_->picking().picked());
  live_->key('M', false);
  frames();
  EXPECT_NE(live_->settings().view.display, "radiosity");
}

TEST_F(Controls, WhatTheMouseRestsOnSaysWhatItIs) {
  act("materials", "on");
  act("pick", "0.45,0.6");
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  const ImRect box = panel->InnerRect;
  std::set<int> rows;  // that a tooltip opens for
  int places = 0;
  // Down the names at the left of the panel, and across buttons.
  for (const float share : {0.08f, 0.9f}) {
    for (float y = 2; y < std::min(box.Max.y, box.Min.y + panel->ContentSize.y);
         y += 2 * kMouseStep, ++places) {
      mouseTo({box.Min.x + share * box.GetWidth(), y});
      frames(1);  // ImGui shows a new window one frame late
      const ImGuiWindow* tip = tooltipShown();
      if (!tip) continue;
      rows.insert(static_cast<int>(y));
      const ImRect at = tip->Rect();
      EXPECT_GE(at.Min.x, 0) << y;
      EXPECT_GE(at.Min.y, 0) << y;
      EXPECT_LE(at.Max.x, static_cast<float>(live_.width())) << y;
      EXPECT_LE(at.Max.y, static_cast<float>(live_.height())) << y;
    }
  }
  std::printf("[ MEASURED ] a tooltip at %zu of %d places\n", rows.size(), places);
  EXPECT_GT(rows.size(), 45u);
  mouseTo({-1000, -1000});
  frames(1);
  EXPECT_FALSE(tooltipShown());
}

// In a small window too, whose edges are near everywhere.
TEST_F(Controls, TooltipsStayWithinASmallWindow) {
  act("size", "640x360");
  act("panel", "on");  // over the scene
  const ImGuiWindow* panel = childOf("panel", "sections");
  ASSERT_TRUE(panel);
  int tips = 0;
  for (float y = 4; y < 356; y += 2 * kMouseStep) {
    mouseTo({panel->InnerRect.Min.x + 20, y});
    frames(1);
    const ImGuiWindow* tip = tooltipShown();
    if (!tip) continue;
    ++tips;
    const ImRect at = tip->Rect();
    EXPECT_TRUE(at.Min.x >= 0 && at.Min.y >= 0 && at.Max.x <= 640 && at.Max.y <= 360) << y;
  }
  EXPECT_GT(tips, 5);
}

// The real window, where the model of the same size says that a control is.
TEST(ControlsOfTheWindow, FollowTheMouse) {
  std::map<std::string, ImVec2> places;
  {
    LiveViewer::Options options;
    options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
    options.solve.elements = 300;
    options.width = 1020;
    options.height = 1050;
    LiveViewer model(options);
    ASSERT_TRUE(model.untilPhase(SessionPhase::kConverged));
    openSection(model->ui(), "camera", true);
    ASSERT_TRUE(model.until([&] { return model->nextFrame(0) > 1e30; }));
    for (int frame = 0; frame < 3; ++frame) model.draw();
    const ImGuiWindow* panel = childOf("panel", "sections");
    ASSERT_TRUE(panel);
    for (float y = panel->InnerRect.Min.y; y < panel->InnerRect.Max.y; y += kMouseStep) {
      ImGui::GetIO().MousePos = {panel->InnerRect.Min.x + 0.6f * panel->InnerRect.GetWidth(), y};
      model->input();
      model.draw();
      for (const char* label : {"##exposure", "##angle"}) {
        if (ImGui::GetCurrentContext()->HoveredId == idOf(label, panel->ID))
          places.emplace(label, ImGui::GetIO().MousePos);
      }
    }
  }
  ASSERT_TRUE(places.contains("##exposure") && places.contains("##angle"));
  const Screen screen;
  const TempFolder folder;
  WindowRun run({"--size", "1020x1050", "--elements", "300", "--script",
                 folder.write("camera.script", "section camera on\n")});
  ASSERT_TRUE(run.hasTitle("cornell_box \u2013 Unshot"));
  std::string scene = run.sceneAtRest();
  const auto move = [&](const ImVec2& at) {
    xdotool("mousemove --window " + run.window() + " " + std::to_string(static_cast<int>(at.x)) + " " +
            std::to_string(static_cast<int>(at.y)));
  };
  for (const auto& place : places) {
    SCOPED_TRACE(place.first);
    int by = 0;
    EXPECT_TRUE(eventually([&] {
      by = by == 30 ? -30 : 30;
      move(place.second);
      // In a person's time: a click and Ctrl within one frame would be a click with Ctrl.
      xdotool("mousedown 1 sleep 0.1 mousemove_relative -- " + std::to_string(by) +
              " 0 sleep 0.1 mouseup 1 sleep 0.1");
      return run.scene() != scene || HasFailure();
    })) << "the picture does not follow the slider";
    scene = run.sceneAtRest();
  }
  // A tooltip is seen in a picture of the window.
  const auto picture = [&] { return run.folder().read(run.screenshot("F12")); };
  move({200, 300});
  const std::string without = picture();
  move({1020 - 320 + 30, places.at("##exposure").y});
  EXPECT_TRUE(eventually([&] { return picture() != without || HasFailure(); })) << "no tooltip";
  run.key("ctrl+q");
  EXPECT_EQ(run.end().code, 0);
}

}  // namespace
}  // namespace unshot
