#include "viewer/panels/sections.h"

#include <imgui.h>

#include <array>
#include <utility>

#include "viewer/panels/bounce_panel.h"
#include "viewer/panels/camera_panel.h"
#include "viewer/panels/display_panel.h"
#include "viewer/panels/error_panel.h"
#include "viewer/panels/hemicube_panel.h"
#include "viewer/panels/materials_panel.h"
#include "viewer/panels/messages_panel.h"
#include "viewer/panels/notes_panel.h"
#include "viewer/panels/picked_panel.h"
#include "viewer/panels/plan_panel.h"
#include "viewer/panels/scene_panel.h"
#include "viewer/panels/solve_panel.h"

namespace unshot {

std::span<const PanelSection> panelSections() {
  // Warnings stand first, notes alone near the end; one switch opens both. What was asked for by a click is
  // open.
  static constexpr std::array<PanelSection, 17> table = {{
      {{"warnings", "Warnings on the scene", ""}, warningsSection, &ViewerState::notes},
      {{"picked", "Picked", ""}, pickedSection, nullptr, "###Picked", true},
      {{"probes", "Probes", ""}, probesSection, nullptr, "###probes", true},
      {{"solve", "Solve", ""}, solveSection, nullptr, "Solve", true},
      {{"errors", "Errors", ""}, errorsSection, nullptr, "###Errors"},
      {{"convergence", "Convergence", ""}, convergenceSection, nullptr, "Convergence"},
      {{"display", "Display", ""}, displaySection, nullptr, "Display", true},
      {{"mesh", "Mesh", ""}, meshSection, nullptr, "Mesh"},
      {{"camera", "Camera", ""}, cameraSection, nullptr, "Camera"},
      {{"scene", "Scene", ""}, sceneSection, nullptr, "Scene"},
      {{"materials", "Materials", ""}, materialsSection, &ViewerState::materials},
      {{"bounces", "Bounces", ""}, bouncesSection, nullptr, "###Bounces"},
      {{"lecture", "Lecture", ""}, teachingSection, nullptr, "Lecture"},
      {{"figures", "Figures", ""}, figuresSection, nullptr, "###Figures"},
      {{"left-out", "Left out", ""}, planSection, &ViewerState::left_out},
      {{"notes", "Notes on the scene", ""}, notesSection, &ViewerState::notes},
      {{"messages", "Messages", ""}, messagesSection, nullptr, "###messages"},
  }};
  return table;
}

void openSection(ViewerState& ui, const std::string& key, std::optional<bool> open) {
  findChoice(panelSections(), key, "section of the panel");
  ui.section_changes.emplace_back(key, open);
}

namespace {

/// Returns whether it is open now.
bool change(ViewerState& ui, const PanelSection& row, std::optional<bool> wanted) {
  if (row.open) return ui.*row.open = wanted.value_or(!(ui.*row.open));
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID(row.label);
  const bool open = wanted.value_or(storage.GetInt(id, row.at_first ? 1 : 0) == 0);
  storage.SetInt(id, open ? 1 : 0);
  return open;
}

}  // namespace

void buildSections(Viewer& viewer) {
  ViewerState& ui = viewer.ui();
  std::string_view scroll_to;
  for (const auto& [key, open] : std::exchange(ui.section_changes, {})) {
    const PanelSection& row = findChoice(panelSections(), key, "section of the panel");
    if (change(ui, row, open)) scroll_to = row.info.key;
  }
  for (const PanelSection& row : panelSections()) {
    const float top = ImGui::GetCursorPosY();
    if (!row.open) ImGui::SetNextItemOpen(row.at_first, ImGuiCond_FirstUseEver);
    row.build(viewer);
    if (row.info.key == scroll_to) ImGui::SetScrollFromPosY(top - ImGui::GetScrollY(), 0);
  }
}

}  // namespace unshot
