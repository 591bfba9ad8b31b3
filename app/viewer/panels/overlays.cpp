// What lies over the scene: messages, what is being loaded, help and prompts.
#include <imgui_internal.h>

#include <algorithm>
#include <vector>

#include "base/clock.h"
#include "base/text.h"
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

/// The lines of the message that is to be read.
struct ErrorText {
  std::string where, what, advice;
};

ErrorText errorText(const Error& error, float width) {
  return {brokenText(error.where(), width), brokenText(error.what(), width),
          error.advice().empty() ? "" : brokenText("Try: " + error.advice(), width)};
}

/// Of its window.
float errorHeight(const ErrorText& text) {
  const ImGuiStyle& style = ImGui::GetStyle();
  float height = 2 * style.WindowPadding.y + ImGui::GetFrameHeight();
  for (const std::string& part : {text.where, text.what, text.advice}) {
    if (!part.empty()) height += ImGui::CalcTextSize(part.c_str()).y + style.ItemSpacing.y;
  }
  return height;
}

void errorWindow(Viewer& viewer, const ErrorText& text, float middle) {
  const float size = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({middle, size}, ImGuiCond_Always, {0.5f, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.24f, 0.09f, 0.08f, 0.96f));
  ImGui::PushStyleColor(ImGuiCol_Border, ImVec4(0.75f, 0.3f, 0.25f, 1));
  ImGui::Begin("message", nullptr, kFixed);
  if (!text.where.empty()) ImGui::TextUnformatted(text.where.c_str());
  ImGui::TextUnformatted(text.what.c_str());
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.9f, 0.75f, 0.65f, 1));
  if (!text.advice.empty()) ImGui::TextUnformatted(text.advice.c_str());
  ImGui::PopStyleColor();
  const std::size_t more = viewer.messages().waiting();
  if (ImGui::Button(more > 0 ? "Next###close" : "Close###close")) viewer.perform("dismiss");
  tooltip("Esc");
  if (more > 0) {
    ImGui::SameLine();
    ImGui::TextUnformatted((countedText(more, "more message") + " to read").c_str());
  }
  ImGui::End();
  ImGui::PopStyleColor(2);
}

/// Whether there was one to show.
bool tasksWindow(Viewer& viewer, float middle) {
  std::vector<Task> tasks = viewer.tasks();
  std::erase_if(tasks, [](const Task& task) { return !task.shown(wallSeconds()); });
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

void changedWindow(Viewer& viewer, float middle, float top) {
  ImGui::SetNextWindowPos({middle, std::max(top, ImGui::GetFontSize())}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowBgAlpha(0.94f);
  ImGui::Begin("changed", nullptr, kFixed);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("The scene changed on disk");
  ImGui::SameLine();
  if (ImGui::Button("Reload")) viewer.perform("reload");
  tooltip(
      "F5: reads its files again and solves it; the camera stays, changes of materials go into a new MTL "
      "file");
  ImGui::SameLine();
  if (ImGui::Button("Keep")) viewer.perform("keep-scene");
  tooltip("Esc: goes on with what was read before. The action watch off asks no more");
  ImGui::End();
}

void lineOverScene(const char* id, const std::string& text, ImVec2 at, ImVec2 pivot) {
  ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin(id, nullptr, kFixed | ImGuiWindowFlags_NoInputs);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

/// Files that were written and the like, above the lower edge. Where they stay there is a button to close
/// them; the text itself leaves the mouse to the scene.
void noticeWindow(Viewer& viewer, const std::vector<std::string>& lines, const LowerEdge& edge) {
  const float middle = edge.sceneWidth() / 2, size = ImGui::GetFontSize();
  const float room = std::max(2 * middle, 12 * size) - 3 * size;
  const bool stays = viewer.messages().stays();
  std::vector<std::string> broken;
  float widest = 0, height = 2 * ImGui::GetStyle().WindowPadding.y;
  const float button = stays ? ImGui::CalcTextSize("\u00d7").x + 3 * ImGui::GetStyle().FramePadding.x : 0;
  for (const std::string& one : lines) {
    broken.push_back(brokenText(one, room - button));
    const ImVec2 text = ImGui::CalcTextSize(broken.back().c_str());
    widest = std::max(widest, text.x);
    height += text.y + ImGui::GetStyle().ItemSpacing.y;
  }
  // Beside the lecture the scene may be narrower than a word.
  const float half = (widest + button) / 2 + ImGui::GetStyle().WindowPadding.x + 2;
  const float x = std::max(middle, half), gap = 0.7f * size;
  // Above legends and the like; over them where there is no room for both.
  float y = edge.above(x - half, x + half) - gap;
  if (y - height < edge.top()) y = edge.bottom() - gap;
  ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("notice", nullptr, kFixed | (stays ? 0 : ImGuiWindowFlags_NoInputs));
  ImGui::BeginGroup();
  for (const std::string& one : broken) ImGui::TextUnformatted(one.c_str());
  ImGui::EndGroup();
  if (stays) {
    ImGui::SameLine();
    if (ImGui::SmallButton("\u00d7")) viewer.perform("dismiss-notices");
    tooltip("Esc. All messages of late are under \"Messages\" in the panel");
    const float text = ImGui::GetItemRectMin().x - ImGui::GetWindowPos().x;
    ImGui::SetWindowHitTestHole(ImGui::GetCurrentWindow(), ImGui::GetWindowPos(),
                                {text, ImGui::GetWindowHeight()});
  }
  ImGui::End();
}

}  // namespace

float belowNames(const Viewer& viewer) {
  const float name =
      ImGui::GetFontSize() + 2 * ImGui::GetStyle().WindowPadding.y + ImGui::GetTextLineHeight();
  if (viewer.state().rival) return name + ImGui::GetTextLineHeightWithSpacing();
  return viewer.referencePicture() && !viewer.ui().picture_difference ? name : 0;
}

void buildOverlays(Viewer& viewer, const LowerEdge& edge, bool covered, bool notices, bool looks) {
  const float size = ImGui::GetFontSize();
  const float height = ImGui::GetIO().DisplaySize.y;
  const float middle = edge.sceneWidth() / 2;
  const auto scene_width = static_cast<int>(edge.sceneWidth());
  const SessionState& state = viewer.state();
  if (!viewer.ui().clean && !covered) {
    buildMarks(viewer, scene_width);
    buildRaceLabels(viewer, scene_width);
  }
  if (notices && tasksWindow(viewer, middle)) {
    // What else there is to say is said once it is done.
  } else if (looks) {
    lineOverScene("framing", "looking for a good view \u2026", {middle, height / 2}, {0.5f, 0.5f});
  } else if (state.phase == SessionPhase::kEmpty) {
    lineOverScene("empty", "Drop an OBJ scene here, or Ctrl+O", {middle, height / 2}, {0.5f, 0.5f});
  } else if (state.stopped_by == "no light") {
    const char* dark =
        "No light: nothing in this scene emits any (Ke above 0), nor does a sky. Click a surface, then Make "
        "it a light; take the last change back (Ctrl+Z); or choose a sky in the section Scene";
    lineOverScene("dark", brokenText(dark, std::min(2 * middle - 3 * size, 30 * size)), {middle, height / 2},
                  {0.5f, 0.5f});
  }
  const bool prompt = viewer.ui().prompt.open();
  float top = 1.5f * size;
  if (viewer.error()) {
    const ErrorText text = errorText(*viewer.error(), std::min(2 * middle - 4 * size, 36 * size));
    const float below = 1.5f * size + errorHeight(text);
    // Where both have no room, the message waits until the prompt is closed.
    const bool fits = !prompt || below + leastPromptHeight() <= height;
    if (fits) errorWindow(viewer, text, middle);
    if (fits) top = below;
  } else if (viewer.ui().help) {
    buildHelp(viewer, middle);
  }
  buildPrompt(viewer, middle, top);
  if (viewer.sceneChanged() && !viewer.error() && !prompt && state.phase != SessionPhase::kLoading)
    changedWindow(viewer, middle, edge.top());
  if (!notices || viewer.ui().clean) return;
  std::vector<std::string> lines = viewer.messages().lines();
  if (lines.empty() && viewer.ui().hint) lines.push_back(kHint);
  if (!lines.empty()) noticeWindow(viewer, lines, edge);
}

}  // namespace unshot
