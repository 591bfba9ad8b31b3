#include "viewer/panels/panels.h"

#include <cmath>

#include "viewer/panels/error_panel.h"
#include "viewer/panels/scene_panel.h"
#include "viewer/panels/sections.h"
#include "viewer/panels/status_line.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr double kPanelWidth = 320, kLeastWindow = 900;  // at scale 1 [px]

void head(Viewer& viewer) {
  const SessionState& state = viewer.state();
  const PhaseLook look = phaseLook(state);
  dot(look.colour);
  ImGui::TextUnformatted(look.text.c_str());
  if (state.facts && state.phase != SessionPhase::kLoading) {
    const std::string wrong = errorInFront(state);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(wrong.c_str()).x);
    ImGui::TextUnformatted(wrong.c_str());
    tooltip(
        "How wrong the reflected light still is, RMS of B \u2212 B* over RMS of B* \u2212 E [%]: the bound "
        "of the solver's error, "
        "and with "
        "it, once they are known, the estimates of what form factors and mesh leave wrong. Before there is a "
        "bound: "
        "the light not yet shot");
  }
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
  const bool paused = state.phase == SessionPhase::kPaused;
  ImGui::BeginDisabled(!viewer.solveGoesOn());
  if (ImGui::Button(paused ? "Resume" : "Pause", {width, 0})) viewer.perform("pause");
  tooltip(paused ? "Space: the solve goes on" : "Space: the solve rests until Resume or Step");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!viewer.solveGoesOn() && !viewer.stepsFromNothing());
  if (ImGui::Button("Step", {width, 0})) viewer.perform("step", ImGui::GetIO().KeyShift ? "10" : "");
  tooltip(viewer.stepsFromNothing()
              ? "N: begins again from nothing shot, and pauses after the first shot. With Shift: after ten"
              : "N: the patch chosen next shoots, then the solve pauses. With Shift: ten times");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!state.facts);
  if (ImGui::Button("Restart", {width, 0})) viewer.perform("restart");
  tooltip("Ctrl+R: from the start, nothing shot");
  ImGui::SameLine();
  if (ImGui::Button("Again", {width, 0})) viewer.perform("again");
  tooltip("Shoots again from nothing, with the form factors that are at hand: to see modes compete");
  ImGui::EndDisabled();
}

}  // namespace

int panelWidth(double scale) { return static_cast<int>(std::lround(kPanelWidth * scale)); }

// The scene has most of the window.
int leastWindowWithPanel(double scale) { return static_cast<int>(std::lround(kLeastWindow * scale)); }

void buildSidePanel(Viewer& viewer, int left) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  if (static_cast<float>(left) >= window.x) return;
  ImGui::SetNextWindowPos({static_cast<float>(left), 0});
  ImGui::SetNextWindowSize({window.x - static_cast<float>(left), window.y});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  // The head stays, what is below scrolls.
  chooseScene(viewer);
  head(viewer);
  ImGui::Separator();
  ImGui::BeginChild("sections");
  viewer.followSections(*ImGui::GetStateStorage());
  buildSections(viewer);
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace unshot
