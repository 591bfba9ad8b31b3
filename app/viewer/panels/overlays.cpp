// What lies over the scene: messages, what is being loaded, help and prompts.
#include <algorithm>
#include <vector>

#include "base/clock.h"
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
constexpr double kTaskSeconds = 0.3;  // what takes no longer is not told
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

/// Whether there was one to show.
bool tasksWindow(Viewer& viewer, float middle) {
  std::vector<Task> tasks = viewer.tasks();
  std::erase_if(tasks, [](const Task& task) { return wallSeconds() < task.since + kTaskSeconds; });
  if (tasks.empty()) return false;
  ImGui::SetNextWindowPos({middle, ImGui::GetIO().DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("tasks", nullptr, kFixed);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const Task& task = tasks[k];
    ImGui::PushID(static_cast<int>(k));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(shortened(task.text + " \u2026", 1.2f * middle).c_str());
    ImGui::SameLine();
    if (ImGui::Button("Give up")) viewer.giveUp(task);
    tooltip((k == 0 ? "Esc: " : "") + std::string(task.given_up));
    if (task.done) ImGui::ProgressBar(static_cast<float>(*task.done), {-1, 0.4f * ImGui::GetFontSize()}, "");
    ImGui::PopID();
  }
  ImGui::End();
  return true;
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
  if (tasksWindow(viewer, middle)) {
    // What else there is to say is said once it is done.
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
