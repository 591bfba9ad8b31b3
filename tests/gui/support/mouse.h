// A person's mouse at a viewer in the test: finding controls, pointing, clicking and dragging.
#pragma once

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <initializer_list>
#include <map>
#include <string>

#include "gui/support/gui_layout.h"
#include "gui/support/panel.h"
#include "support/live_viewer.h"

namespace unshot::testing_support {

inline constexpr float kMouseStep = 7;  // [px], less than any control is high

/// A child window, such as the part of the panel that scrolls.
inline const ImGuiWindow* childOf(const char* window, const char* child) {
  const ImGuiWindow* parent = ImGui::FindWindowByName(window);
  if (!parent) return nullptr;
  const std::string start = std::string(window) + "/" + child + "_";
  for (const ImGuiWindow* each : ImGui::GetCurrentContext()->Windows) {
    if (each->Active && std::string(each->Name).starts_with(start)) return each;
  }
  return nullptr;
}

inline const ImGuiWindow* tooltipShown() {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (window->Active && !window->Hidden && std::string(window->Name).starts_with("##Tooltip"))
      return window;
  }
  return nullptr;
}

/// Its letters, as they were drawn last, without blanks.
inline std::string lettersOf(const ImGuiWindow& window) {
  std::string out;
  for (const Letter& letter : Letters(*ImGui::GetIO().Fonts).of(*window.DrawList)) out += letter.text;
  return out;
}

class Mouse {
 public:
  explicit Mouse(LiveViewer& live) : live_(live) {}

  /// Until nothing is to be drawn or awaited any more.
  void rest() {
    ASSERT_TRUE(live_.until([&] { return live_->nextFrame(0) > 1e30 && live_->scriptDone(); }));
  }
  void frames(int count = 2) {
    for (int k = 0; k < count; ++k) {
      live_->input();
      live_.draw();
    }
  }
  void to(const ImVec2& at) {
    ImGui::GetIO().MousePos = at;
    frames();
  }

  /// Where the mouse is over which item of the window, at these parts of its width.
  std::map<ImGuiID, ImVec2> itemsIn(const ImGuiWindow& window, std::initializer_list<float> across) {
    ImRect box = window.InnerRect;
    box.Max.y = std::min(box.Max.y, box.Min.y + window.ContentSize.y);
    return itemsIn(box, across);
  }
  /// The same of a part of the screen.
  std::map<ImGuiID, ImVec2> itemsIn(const ImRect& box, std::initializer_list<float> across) {
    std::map<ImGuiID, ImVec2> found;
    for (const float share : across) {
      for (float y = box.Min.y + 2; y < box.Max.y; y += kMouseStep) {
        ImGui::GetIO().MousePos = {box.Min.x + share * box.GetWidth(), y};
        frames(1);
        if (const ImGuiID id = ImGui::GetCurrentContext()->HoveredId)
          found.emplace(id, ImGui::GetIO().MousePos);
      }
    }
    return found;
  }

  void press(const ImVec2& at) {
    to(at);
    ImGui::GetIO().MouseDown[0] = true;
    frames();
  }
  void letGo() {
    ImGui::GetIO().MouseDown[0] = false;
    frames();
  }
  void click(const ImVec2& at) {
    press(at);
    letGo();
  }
  /// Takes hold of a slider and pulls it to both sides.
  void drag(const ImVec2& at) {
    press(at);
    for (const float by : {-10.0f, -25.0f, 15.0f, 40.0f}) to({at.x + by, at.y});
    letGo();
  }

 private:
  LiveViewer& live_;
};

}  // namespace unshot::testing_support
