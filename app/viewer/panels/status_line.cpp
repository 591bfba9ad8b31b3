#include "viewer/panels/status_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/text.h"
#include "solver/modes.h"
#include "viewer/panels/error_panel.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

// Readable over a bright scene too: 6 : 1.
const ImVec4 kPartColour{0.73f, 0.73f, 0.73f, 1};
constexpr float kLineHeight = 1.5f;  // in letters' heights
constexpr float kGapOfParts = 1.1f;  // between two parts, the same
constexpr std::array<const char*, 4> kWidePhases = {"Refining form factors", "Converged, estimating",
                                                    "Assembling the matrix", "Bounding the spectrum"};

float widestPhase() {
  float width = 0;
  for (const char* phase : kWidePhases) width = std::max(width, ImGui::CalcTextSize(phase).x);
  return width;
}

/// A part of the line. `widest` is the longest text that it usually has: so much room is kept for it, so that
/// nothing moves when a figure gets longer or shorter.
struct Part {
  std::string text;
  const char* widest;
  const char* tip;
};

/// Empty where nothing was drawn.
std::string frameText(double milliseconds) {
  if (milliseconds < 0.05) return {};
  char text[32];
  std::snprintf(text, sizeof text, milliseconds < 9.95 ? "frame %.1f ms" : "frame %.0f ms", milliseconds);
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string modeText(const SessionState& state) {
  return std::string(findChoice(iterationModes(), state.facts->mode, "iteration mode").info.title);
}

std::array<Part, 6> partsOf(const Viewer& viewer) {
  const SessionState& state = viewer.state();
  const bool solving = state.facts && state.phase != SessionPhase::kLoading;
  const bool running = state.phase == SessionPhase::kRunning;
  const auto rows = static_cast<std::uint64_t>(viewer.rates().columns);
  const std::string nothing;
  return {{
      {solving ? "unshot " + percentText(state.measures.unshot_fraction) : nothing, "unshot 0.0012 %",
       "Light that is emitted or reflected but not yet shot: \u2211 A |U| / \u2211 A E over patches and "
       "channels [%]"},
      {solving ? knownError(state) : nothing, "error about 0.0012 %",
       "How wrong the reflected light still is, RMS of B \u2212 B* over RMS of B* \u2212 E [%]; "
       "\"solver below\": a proven bound of what the solver has left, before form factors and mesh are "
       "estimated; \"about\": an estimate of all of it, \"up to\" the upper end of one that noise hides, or "
       "that is mostly that bound"},
      {running ? countText(rows) + " rows/s" : nothing, "00,000 rows/s",
       "Columns and rows of the form factors K computed a second, those kept from before not counted [1/s]"},
      {frameText(viewer.frameMilliseconds()), "frame 000 ms",
       "Time to draw the scene and the panels once [ms]; a slow renderer does it over several frames"},
      {solving ? modeText(state) : nothing, "Progressive refinement",
       "Iteration mode: how it is chosen what is shot next"},
      {viewer.renderer().renderer, "", "What draws the picture"},
  }};
}

}  // namespace

PhaseLook phaseLook(const SessionState& state) {
  switch (state.phase) {
    case SessionPhase::kEmpty:
      return {"No scene", {0.55f, 0.55f, 0.55f, 1}};
    case SessionPhase::kLoading:
      return {"Loading", {0.95f, 0.75f, 0.3f, 1}};
    case SessionPhase::kRunning:
      if (state.finer_mesh) return {"Refining the mesh", {0.98f, 0.72f, 0.25f, 1}};
      if (state.facts && state.measures.solverBound() <= state.facts->solver_target)
        return {state.measures.drafts > 0 ? "Refining form factors" : "Sharpening", {0.98f, 0.72f, 0.25f, 1}};
      return {state.activity.empty() ? "Shooting" : capitalised(state.activity), {0.98f, 0.72f, 0.25f, 1}};
    case SessionPhase::kPaused:
      return {"Paused", {0.6f, 0.7f, 0.85f, 1}};
    case SessionPhase::kConverged:
      if (state.stopped_by == "no light") return {"No light", {0.85f, 0.75f, 0.5f, 1}};
      // What the solve shows is as it will be; how wrong it is gets better known.
      return {state.spareWork() && !state.bounces_under_way && !state.gathering ? "Converged, estimating"
                                                                                : "Converged",
              {0.5f, 0.85f, 0.5f, 1}};
    case SessionPhase::kStopped:
      return {"Limit reached", {0.85f, 0.75f, 0.5f, 1}};
    case SessionPhase::kFailed:
      break;
  }
  return {"Failed", {0.95f, 0.4f, 0.35f, 1}};
}

namespace {

/// What shows the panel where it has no room, as much of it as is no wider than this; empty where the panel
/// is there.
std::string missingPanel(const Viewer& viewer, float room) {
  if (viewer.teaching().choices.lecture || panelHasRoom(viewer)) return {};
  return shortened("Tab: the panel", room);
}

/// How far the solve is, along the upper edge of the window.
void progressLine(const SessionState& state) {
  if (state.phase != SessionPhase::kRunning) return;
  const ImVec2 at = ImGui::GetWindowPos();
  const float thick = std::max(1.0f, std::round(0.13f * ImGui::GetFontSize()));
  const auto width = static_cast<float>(state.progress) * ImGui::GetWindowWidth();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRectFullScreen();  // to the corner, beside which text keeps a distance
  list.AddRectFilled(at, {at.x + std::round(width), at.y + thick},
                     ImGui::GetColorU32(phaseLook(state).colour));
  list.PopClipRect();
}

void missingPanelTip(const Viewer& viewer) {
  tooltip(
      "Beside the scene the panel takes a window of " +
      countText(static_cast<std::uint64_t>(leastWindowWithPanel(viewer.scale()))) +
      " px at this scale: make the window wider (action size), or panels and text smaller (Ctrl+P, action "
      "scale 1). Tab lays it over the scene, and takes it away again");
}

}  // namespace

float buildStatusLine(Viewer& viewer, int scene_width) {
  if (!viewer.ui().panel || !viewer.ui().status) return 0;
  const float em = ImGui::GetFontSize(), height = std::round(kLineHeight * em);
  const float phase = 0.7f * em + 0.8f * em + widestPhase();
  const bool cramped = static_cast<float>(scene_width) < phase + 0.7f * em;
  const PhaseLook look = phaseLook(viewer.state());
  const float shown = cramped ? 0 : (0.8f + kGapOfParts) * em + ImGui::CalcTextSize(look.text.c_str()).x;
  const std::string no_panel = missingPanel(viewer, static_cast<float>(scene_width) - 1.5f * em - shown);
  if (cramped && no_panel.empty()) return 0;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, window.y - height});
  ImGui::SetNextWindowSize({static_cast<float>(scene_width), height});
  ImGui::SetNextWindowBgAlpha(0.92f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.7f * em, 0.5f * (height - em)));
  ImGui::Begin("status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoScrollWithMouse);
  const float end = static_cast<float>(scene_width) - 0.7f * em;
  progressLine(viewer.state());
  if (!cramped) {
    dot(look.colour);
    ImGui::TextUnformatted(look.text.c_str());
    tooltip("What the solve is doing; the line above is how far it is. Tab hides both with the panel");
  }
  float at = phase + kGapOfParts * em;
  if (!no_panel.empty()) {
    if (!cramped) ImGui::SameLine(0, kGapOfParts * em);
    ImGui::TextUnformatted(no_panel.c_str());
    at = ImGui::GetItemRectMax().x + kGapOfParts * em;
    missingPanelTip(viewer);
  }
  for (const Part& part : partsOf(viewer)) {
    const float width =
        std::max(ImGui::CalcTextSize(part.widest).x, ImGui::CalcTextSize(part.text.c_str()).x);
    if (at + width > end) break;
    if (!part.text.empty()) {
      ImGui::SameLine(at);
      ImGui::TextColored(kPartColour, "%s", part.text.c_str());
      tooltip(part.tip);
    }
    at += width + kGapOfParts * em;
  }
  ImGui::End();
  ImGui::PopStyleVar(4);
  return height;
}

}  // namespace unshot
