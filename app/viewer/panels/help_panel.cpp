#include "viewer/panels/help_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "viewer/actions/actions.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

// In letters' heights.
constexpr float kKeys = 6.3f, kColumn = 27, kNarrowest = 18;

struct HelpRow {
  std::string keys, what;
};
struct HelpGroup {
  std::string title;
  std::vector<HelpRow> rows;
};

/// Flight goes by the places of keys, whatever this keyboard has there.
std::string flightKeys(const Viewer& viewer) {
  std::string text = "W A S D, Q E";
  for (char& c : text) {
    if (c >= 'A') c = viewer.printedOn(c);
  }
  return text;
}

std::vector<HelpGroup> helpGroups(const Viewer& viewer) {
  std::vector<HelpGroup> groups{{"Mouse and flight",
                                 {{"Click", "What is there: light, element, plan"},
                                  {"Left drag", "Orbit around the point looked at"},
                                  {"Right drag", "Look around"},
                                  {"Middle drag", "Move sideways and up; also Shift+left drag"},
                                  {"Wheel", "To what is under the mouse, and away from it"},
                                  {flightKeys(viewer), "Fly; down and up. Shift: faster"},
                                  {"Right, wheel", "Speed of flight"},
                                  {"Drop a file", "Open it, or compare with it"}}}};
  for (const ActionGroup& group : actionGroups()) {
    HelpGroup help{std::string(group.title), {}};
    for (const Action& action : group.actions) {
      if (action.shortcut.key != 0)
        help.rows.push_back({std::string(action.shortcut.text), std::string(action.help)});
    }
    if (!help.rows.empty()) groups.push_back(std::move(help));
  }
  return groups;
}

void showGroup(const HelpGroup& group, float width) {
  const float size = ImGui::GetFontSize();
  ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_PlotLines), "%s", group.title.c_str());
  if (!ImGui::BeginTable(group.title.c_str(), 2, ImGuiTableFlags_None, {width, 0})) return;
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, kKeys * size);
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  for (const HelpRow& row : group.rows) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.keys.c_str());
    ImGui::TableNextColumn();
    wrapped(row.what);
  }
  ImGui::EndTable();
  ImGui::Spacing();
}

/// How many of the groups stand in the first of two columns, so that the longer one is short.
std::size_t firstColumn(const std::vector<HelpGroup>& groups, float width) {
  std::vector<float> height;
  for (const HelpGroup& group : groups) {
    height.push_back(2.5f);
    for (const HelpRow& row : group.rows)
      height.back() +=
          std::ceil(ImGui::CalcTextSize(row.what.c_str()).x / (width - kKeys * ImGui::GetFontSize()));
  }
  const float all = std::accumulate(height.begin(), height.end(), 0.0f);
  float left = 0;
  std::size_t count = 0;
  while (count < groups.size() && left + height[count] / 2 < all / 2) left += height[count++];
  return count;
}

}  // namespace

void buildHelp(const Viewer& viewer, float middle) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float size = ImGui::GetFontSize(), height = ImGui::GetIO().DisplaySize.y;
  const float room = 2 * middle - size - 2 * style.WindowPadding.x - style.ScrollbarSize;
  const bool two = room >= 2 * kNarrowest * size + 2 * size;
  const float column = std::min(two ? room / 2 - size : room, kColumn * size);
  ImGui::SetNextWindowPos({middle, height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {2 * middle, height - size});
  ImGui::SetNextWindowBgAlpha(0.94f);
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  const std::vector<HelpGroup> groups = helpGroups(viewer);
  const std::size_t first = two ? firstColumn(groups, column) : groups.size();
  ImGui::BeginGroup();
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (k == first) {
      ImGui::EndGroup();
      ImGui::SameLine(0, 2 * size);
      ImGui::BeginGroup();
    }
    showGroup(groups[k], column);
  }
  ImGui::EndGroup();
  ImGui::TextDisabled("Ctrl+P: all actions, to search and to perform");
  ImGui::End();
}

}  // namespace unshot
