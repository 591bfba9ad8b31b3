#include "viewer/panels/race_panel.h"

#include "base/text.h"
#include "solver/modes.h"
#include "viewer/panels/error_panel.h"
#include "viewer/panels/widgets.h"
#include "viewer/scene_area.h"

namespace unshot {
namespace {

std::string modeTitle(const LaneState& lane) {
  return std::string(findChoice(iterationModes(), lane.facts->mode, "iteration mode").info.title);
}

const char* endingOf(const LaneState& lane) {
  switch (lane.own_phase) {
    case SessionPhase::kConverged:
      return "converged at ";
    case SessionPhase::kStopped:
      return "limit reached at ";
    case SessionPhase::kFailed:
      return "failed at ";
    default:
      return "";
  }
}

// "0.52 s, 3 % unshot", what both have from the first moment, or as much of it as is no wider than this.
std::string standing(const LaneState& lane, float width) {
  const std::string unshot = percentText(lane.measures.unshot_fraction) + " unshot";
  const std::string moment = durationText(lane.measures.seconds) + ", " + unshot;
  for (const std::string& text : {endingOf(lane) + moment, moment}) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  }
  return unshot;
}

void raceLabel(const char* id, const LaneState& lane, bool rival, float middle, float width) {
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({middle, 0.7f * em}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width, 10 * em});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoInputs);
  dot(raceColour(rival));
  const float room = width - 2 * ImGui::GetStyle().WindowPadding.x;
  ImGui::TextUnformatted(shortened(modeTitle(lane), room - em).c_str());
  ImGui::TextDisabled("%s", standing(lane, room).c_str());
  ImGui::End();
}

}  // namespace

ImVec4 raceColour(bool rival) {
  return rival ? ImVec4(0.42f, 0.72f, 0.98f, 1) : ImGui::GetStyleColorVec4(ImGuiCol_PlotLines);
}

bool sectionOfLeft(const char* title, const SessionState& state) {
  // What follows ### is its identity.
  return section((std::string(title) + (state.rival ? ", left picture###" : "###") + title).c_str());
}

void chooseRival(Viewer& viewer) {
  const SessionState& state = viewer.state();
  label("Race against",
        "Both solves begin with nothing shot and take turns, each as long as the other by its own clock: two "
        "pictures and two curves side by side");
  ImGui::BeginDisabled(!state.facts);
  const std::string shown = state.rival ? modeTitle(*state.rival) : "nothing";
  if (beginCombo("##race", shown)) {
    if (ImGui::Selectable("nothing", !state.rival)) viewer.perform("race", "off");
    for (const IterationModeRow& row : iterationModes()) {
      const std::string title(row.info.title);
      if (ImGui::Selectable(title.c_str(), state.rival && state.rival->facts->mode == row.info.key))
        viewer.perform("race", std::string(row.info.key));
      tooltip(row.info.help);
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
}

void buildRaceLabels(Viewer& viewer, int scene_width) {
  const SessionState& state = viewer.state();
  if (!state.rival || state.phase == SessionPhase::kLoading) return;
  const SceneSplit split = splitScene(scene_width, true);
  const auto width = static_cast<float>(split.left);
  raceLabel("race-left", state, false, width / 2, width);
  raceLabel("race-right", *state.rival, true, static_cast<float>(split.right_at) + width / 2, width);
}

void raceStandings(const SessionState& state) {
  if (!state.rival) return;
  const LaneState* const lanes[] = {&state, &*state.rival};
  for (const LaneState* lane : lanes) {
    dot(raceColour(lane != &state));
    line(modeTitle(*lane).c_str(), solverText(lane->measures),
         "Its curve has the colour of the dot. At the right its solver's error, RMS of B \u2212 B* over RMS "
         "of "
         "B* \u2212 E [%]");
  }
}

}  // namespace unshot
