// What lies over the scene: messages, what is being loaded, help and prompts.
#include <algorithm>

#include "viewer/panels/help_panel.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/picked_panel.h"
#include "viewer/panels/prompt_panel.h"
#include "viewer/panels/race_panel.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoFocusOnAppearing;
constexpr const char* kHint = "Drag to orbit, click to pick, H for help, Ctrl+P for all actions";

void errorWindow(Viewer& viewer, float middle) {
  const Error& error = *viewer.error();
  const float size = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({middle, size}, ImGuiCond_Always, {0.5f, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.24f, 0.09f, 0.08f, 0.96f));
  ImGui::PushStyleColor(ImGuiCol_Border, ImVec4(0.75f, 0.3f, 0.25f, 1));
  ImGui::Begin("message", nullptr, kFixed);
  ImGui::PushTextWrapPos(std::min(2 * middle - 4 * size, 36 * size));
  if (!error.where().empty()) ImGui::TextUnformatted(error.where().c_str());
  ImGui::TextUnformatted(error.what());
  if (!error.advice().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.9f, 0.75f, 0.65f, 1));
    ImGui::TextUnformatted(("Try: " + error.advice()).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Close")) viewer.perform("dismiss");
  ImGui::End();
  ImGui::PopStyleColor(2);
}

void loadingWindow(Viewer& viewer, float middle) {
  ImGui::SetNextWindowPos({middle, ImGui::GetIO().DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("loading", nullptr, kFixed);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted((viewer.state().task + " \u2026").c_str());
  ImGui::SameLine();
  if (ImGui::Button("Give up")) viewer.perform("give-up");
  tooltip("Esc: the scene before stays");
  ImGui::End();
}

/// Between the message above and the notice below.
void changedWindow(Viewer& viewer, float middle) {
  const float size = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({middle, size}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowBgAlpha(0.94f);
  ImGui::Begin("changed", nullptr, kFixed);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("The scene changed on disk");
  ImGui::SameLine();
  if (ImGui::Button("Reload")) viewer.perform("reload");
  tooltip("F5: reads its files again and solves it; the camera stays, changes of materials go");
  ImGui::SameLine();
  if (ImGui::Button("Keep")) viewer.perform("dismiss");
  tooltip("Esc: goes on with what was read before. The action watch off asks no more");
  ImGui::End();
}

void line(const char* id, const std::string& text, ImVec2 at, ImVec2 pivot) {
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin(id, nullptr, kFixed | ImGuiWindowFlags_NoInputs);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

}  // namespace

void buildOverlays(Viewer& viewer, int scene_width, float bottom, const std::string& notice, bool framing) {
  const float size = ImGui::GetFontSize();
  const float height = ImGui::GetIO().DisplaySize.y;
  const float middle = static_cast<float>(scene_width) / 2;
  const SessionState& state = viewer.state();
  if (!viewer.ui().clean) {
    buildMarks(viewer, scene_width);
    buildRaceLabels(viewer, scene_width);
  }
  if (state.phase == SessionPhase::kLoading) {
    loadingWindow(viewer, middle);
  } else if (framing && state.facts) {
    line("framing", "looking for a good view \u2026", {middle, height / 2}, {0.5f, 0.5f});
  } else if (state.phase == SessionPhase::kEmpty && !viewer.error()) {
    line("empty", "Drop an OBJ scene here, or Ctrl+O", {middle, height / 2}, {0.5f, 0.5f});
  } else if (state.stopped_by == "no light") {
    line("dark", "No light: no face of this scene emits any (Ke above 0), nor does a sky",
         {middle, height / 2}, {0.5f, 0.5f});
  }
  if (viewer.error()) {
    errorWindow(viewer, middle);
  } else if (viewer.ui().help) {
    buildHelp(middle);
  }
  buildPrompt(viewer, middle);
  if (viewer.sceneChanged() && !viewer.error() && state.phase != SessionPhase::kLoading)
    changedWindow(viewer, middle);
  const std::string said = notice.empty() && viewer.ui().hint ? kHint : notice;
  if (!said.empty())
    line("notice", brokenText(said, 2 * middle - 3 * size), {middle, bottom - 0.7f * size}, {0.5f, 1});
}

}  // namespace unshot
