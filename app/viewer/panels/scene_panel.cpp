#include "viewer/panels/scene_panel.h"

#include <algorithm>

#include "viewer/panels/widgets.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr std::size_t kRecent = 10;

void sceneRow(Viewer& viewer, const std::filesystem::path& scene) {
  const SessionState& state = viewer.state();
  const bool present = state.facts && state.facts->scene_path == scene;
  ImGui::PushID(scene.c_str());
  if (ImGui::Selectable(scene.stem().string().c_str(), present)) viewer.perform("open", scene.string());
  tooltip(scene.string());
  ImGui::PopID();
}

/// The bundled ones, those opened of late, and the way to others.
void sceneRows(Viewer& viewer) {
  const auto& bundled = viewer.bundledScenes();
  std::vector<std::filesystem::path>& recent = viewer.ui().recent;
  if (ImGui::IsWindowAppearing()) {
    recent = viewer.memory().scenes();
    std::erase_if(recent, [&](const auto& scene) {
      return std::find(bundled.begin(), bundled.end(), scene) != bundled.end();
    });
    recent.resize(std::min(recent.size(), kRecent));
  }
  for (const std::filesystem::path& scene : bundled) sceneRow(viewer, scene);
  if (!recent.empty()) ImGui::Separator();
  for (const std::filesystem::path& scene : recent) sceneRow(viewer, scene);
  ImGui::Separator();
  if (ImGui::Selectable("Browse \u2026")) viewer.perform("browse");
  tooltip("Ctrl+O: looks for an OBJ file. Or drop one on the window");
}

}  // namespace

void chooseScene(Viewer& viewer) {
  const SessionState& state = viewer.state();
  const ImGuiStyle& style = ImGui::GetStyle();
  const float buttons = ImGui::CalcTextSize("Save").x + ImGui::CalcTextSize("Help").x +
                        4 * style.FramePadding.x + 2 * style.ItemSpacing.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - buttons);
  const std::string shown = state.facts ? state.facts->scene_name : "no scene";
  if (ImGui::BeginCombo("##scene", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
    sceneRows(viewer);
    ImGui::EndCombo();
  } else {
    tooltip(state.facts ? state.facts->scene_path.string() : "Scenes to begin with");
  }
  ImGui::SameLine();
  ImGui::BeginDisabled(!state.facts);
  if (ImGui::Button("Save")) viewer.perform("save-solve");
  tooltip(
      "Ctrl+S: saves the solve with its form factors in the working folder. unshot view SCENE.obj --resume "
      "FILE goes on from it");
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("Help")) viewer.perform("help");
  tooltip("H: keys and mouse");
}

}  // namespace unshot
