#include "viewer/panels/scene_panel.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "scene/sky.h"
#include "viewer/panels/widgets.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr std::size_t kRecent = 10;

/// `folder`: with its folder's name, where others are called like it.
void sceneRow(Viewer& viewer, const std::filesystem::path& scene, bool folder) {
  const SessionState& state = viewer.state();
  const bool present = state.facts && state.facts->scene_path == scene;
  ImGui::PushID(scene.c_str());
  const std::string name =
      scene.stem().string() + (folder ? " in " + scene.parent_path().filename().string() : std::string());
  if (ImGui::Selectable(name.c_str(), present)) viewer.perform("open", scene.string());
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
  const auto called = [](const auto& scenes, const std::filesystem::path& scene) {
    return std::count_if(scenes.begin(), scenes.end(),
                         [&](const std::filesystem::path& other) { return other.stem() == scene.stem(); });
  };
  for (const std::filesystem::path& scene : bundled) sceneRow(viewer, scene, false);
  if (!recent.empty()) ImGui::Separator();
  for (const std::filesystem::path& scene : recent)
    sceneRow(viewer, scene, called(bundled, scene) + called(recent, scene) > 1);
  ImGui::Separator();
  if (ImGui::Selectable("Browse \u2026")) viewer.perform("browse");
  tooltip(
      "Ctrl+O: looks for an OBJ file, or a saved solve (.unshot) of this scene. Or drop one on the window");
}

void chooseSky(Viewer& viewer) {
  struct Choice {
    const char *key, *title;
  };
  static constexpr std::array<Choice, 4> kChoices = {{{"auto", "where no face emits"},
                                                      {"0,0,0", "none"},
                                                      {"1,1,1", "white, 1 W/m\u00b2"},
                                                      {"0.6,0.8,1", "blue, 0.6, 0.8, 1 W/m\u00b2"}}};
  label("Sky",
        "Uniform radiosity of what lies around the scene [W/m\u00b2]; the action sky takes any. Another one "
        "solves again from the start");
  const auto isChosen = [&](const Choice& c) { return parseSky(c.key) == viewer.ui().options.sky; };
  const auto chosen = std::find_if(kChoices.begin(), kChoices.end(), isChosen);
  const auto& own = viewer.ui().options.sky;
  const std::string shown = chosen != kChoices.end() ? chosen->title
                                                     : figureText(own->x) + ", " + figureText(own->y) + ", " +
                                                           figureText(own->z) + " W/m\u00b2";
  if (!beginCombo("##sky", shown)) return;
  for (const Choice& choice : kChoices) {
    if (ImGui::Selectable(choice.title, isChosen(choice))) viewer.perform("sky", choice.key);
  }
  ImGui::EndCombo();
}

void chooseEmission(Viewer& viewer) {
  label("Lights",
        "Whether lights emit on both sides, or on their front alone, where the corners of their polygons run "
        "counter-clockwise. Another choice solves again from the start");
  const bool front = viewer.ui().options.emit_front_only;
  if (!ImGui::BeginCombo("##emit", front ? "front alone" : "both sides")) return;
  if (ImGui::Selectable("both sides", !front)) viewer.perform("emit", "both");
  if (ImGui::Selectable("front alone", front)) viewer.perform("emit", "front");
  ImGui::EndCombo();
}

}  // namespace

void sceneSection(Viewer& viewer) {
  if (!section("Scene")) return;
  const SessionState& state = viewer.state();
  if (!state.facts || !state.snapshot) {
    ImGui::TextDisabled("nothing yet");
    return;
  }
  const Mesh& mesh = *state.snapshot->mesh;
  line("Triangles", countText(state.facts->triangles),
       "Number of triangles of the file's faces; those without area are left out");
  line("Materials", countText(mesh.materials.size()), "Number of materials in the MTL files");
  const glm::dvec3 extent = mesh.bounds_max - mesh.bounds_min;
  line("Extent",
       figureText(extent.x) + " \u00d7 " + figureText(extent.y) + " \u00d7 " + figureText(extent.z) + " m",
       "Along x, y and z [m]; OBJ files are in metres");
  chooseSky(viewer);
  chooseEmission(viewer);
}

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
