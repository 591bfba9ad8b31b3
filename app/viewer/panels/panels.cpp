#include "viewer/panels/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/text.h"
#include "formfactor/methods.h"
#include "mesh/build.h"
#include "solver/modes.h"
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
#include "viewer/panels/race_panel.h"
#include "viewer/panels/scene_panel.h"
#include "viewer/panels/status_line.h"
#include "viewer/panels/theme.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr double kPanelWidth = 304;  // at scale 1 [px]

/// The title of what is in use: with `auto` what that became, once it is known.
template <class Row>
std::string shownChoice(std::span<const Row> table, const std::string& asked, const std::string& became) {
  if (asked != "auto") return titleOf(table, asked);
  return became.empty() ? "Automatic" : titleOf(table, became);
}

void head(Viewer& viewer) {
  const SessionState& state = viewer.state();
  const PhaseLook look = phaseLook(state);
  dot(look.colour);
  ImGui::TextUnformatted(look.text);
  if (state.facts && state.phase != SessionPhase::kLoading) {
    const std::string wrong = errorInFront(state);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(wrong.c_str()).x);
    ImGui::TextUnformatted(wrong.c_str());
    tooltip(
        "How wrong the reflected light still is (RMS error over RMS light): the bound of the solver's error, "
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
  ImGui::SameLine();
  if (ImGui::Button("Step", {width, 0})) viewer.perform("step", ImGui::GetIO().KeyShift ? "10" : "");
  tooltip("N: the patch chosen next shoots, then the solve pauses. With Shift: ten times");
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

void chooseElements(Viewer& viewer) {
  static constexpr std::array<std::uint64_t, 7> kChoices = {1'000,   3'000,   10'000,   30'000,
                                                            100'000, 300'000, 1'000'000};
  const SessionState& state = viewer.state();
  const auto& asked = viewer.ui().options.elements;
  label("Elements",
        "How finely the surfaces are cut, over all lit sides. Chosen: 10,000 alike for hemicubes, else as "
        "the light "
        "and the error asked for need. Another fineness solves again from the start");
  const std::string shown =
      state.facts ? countText(state.facts->elements) : countText(asked.value_or(kDefaultElements));
  if (!ImGui::BeginCombo("##elements", shown.c_str())) return;
  for (const std::uint64_t choice : kChoices) {
    const std::string text = "about " + countText(choice);
    if (ImGui::Selectable(text.c_str(), asked == choice)) viewer.perform("elements", std::to_string(choice));
  }
  if (ImGui::Selectable("chosen", !asked)) viewer.perform("elements", "0");
  ImGui::EndCombo();
}

void chooseHemicube(Viewer& viewer) {
  static constexpr std::array<std::uint32_t, 6> kChoices = {0, 32, 64, 128, 256, 512};
  const std::uint32_t asked = viewer.ui().options.hemicube_resolution;
  const auto textOf = [](std::uint32_t n) {
    return n == 0 ? std::string("Automatic") : std::to_string(n) + " px";
  };
  label(
      "Hemicube",
      "Pixels along an edge of the hemicube; lights get up to four times as many. Another resolution solves "
      "again from the start");
  const SessionState& state = viewer.state();
  const bool unused =
      state.facts &&
      !findChoice(formFactorMethods(), state.facts->form_factors, "form-factor method").needs_gl;
  ImGui::BeginDisabled(unused);
  if (ImGui::BeginCombo("##hemicube", textOf(asked).c_str())) {
    for (const std::uint32_t choice : kChoices) {
      if (ImGui::Selectable(textOf(choice).c_str(), choice == asked))
        viewer.perform("hemicube", std::to_string(choice));
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  if (unused) tooltip("This solve draws no hemicubes");
}

void chooseError(Viewer& viewer) {
  struct Choice {
    const char* key;
    double error;
  };
  static constexpr std::array<Choice, 6> kChoices = {
      {{"0.1", 0.1}, {"0.03", 0.03}, {"0.01", 0.01}, {"0.003", 0.003}, {"0.001", 0.001}, {"0.0001", 0.0001}}};
  label("Stop at",
        "The solve ends when its error, RMS of B \u2212 B* over RMS of B* \u2212 E [%], is proven to be "
        "below this; a smaller one "
        "goes on from "
        "there");
  const double error = viewer.ui().options.error;
  if (!ImGui::BeginCombo("##error", (percentText(error) + " error").c_str())) return;
  for (const Choice& choice : kChoices) {
    if (ImGui::Selectable((percentText(choice.error) + " error").c_str(), choice.error == error))
      viewer.perform("error", choice.key);
  }
  ImGui::EndCombo();
}

void solveSection(Viewer& viewer) {
  if (!section("Solve")) return;
  const SessionState& state = viewer.state();
  const SolveOptions& options = viewer.ui().options;
  label("Iteration",
        "How it is chosen what is shot next. B = E + M B has one solution; the ways to it differ. What was "
        "shot and received stays; in a race both begin anew");
  const std::string mode =
      choose("##mode", iterationModes(), options.mode,
             shownChoice(iterationModes(), options.mode, state.facts ? state.facts->mode : ""),
             "Progressive refinement, until errors are known");
  if (!mode.empty()) viewer.perform("mode", mode);
  chooseRival(viewer);
  label("Form factors",
        "G_ij, what part of the light that patch i sends arrives at patch j, between 0 and 1: \u222b\u222b "
        "cos \u03b8_i cos \u03b8_j V / (\u03c0 r\u00b2) dA_j dA_i / A_i, V what is not occluded. Another "
        "method solves again from the start");
  const std::string method = choose(
      "##method", formFactorMethods(), options.form_factors,
      shownChoice(formFactorMethods(), options.form_factors, state.facts ? state.facts->form_factors : ""),
      "Closed form where nothing can occlude, else hemicubes");
  if (!method.empty()) viewer.perform("form-factors", method);
  chooseHemicube(viewer);
  chooseError(viewer);
}

void meshSection(Viewer& viewer) {
  if (!section("Mesh")) return;
  chooseElements(viewer);
  const SessionState& state = viewer.state();
  if (!state.facts || !state.snapshot) return;
  line("Patches, elements", countText(state.facts->patches) + ", " + countText(state.facts->elements),
       "Patches shoot, elements receive; both count lit sides only");
  line("Element size", figureText(state.snapshot->mesh->element_size) + " m",
       "Edge of a full cell aimed at [m]; cells beside borders, contacts and small lamps are smaller");
  line("Surfaces", countText(state.facts->surfaces),
       "Polygons of one material in one plane are one surface where they join");
}

void figuresSection(Viewer& viewer) {
  const SessionState& state = viewer.state();
  if (!sectionOfLeft("Figures", state)) return;
  if (!state.facts) {
    ImGui::TextDisabled("nothing yet");
    return;
  }
  const Rates rates = viewer.rates();
  const bool running = state.phase == SessionPhase::kRunning;
  line("Shots",
       countText(state.measures.shots) +
           (running ? "  (" + countText(static_cast<std::uint64_t>(rates.shots)) + "/s)" : ""),
       "How often a patch has shot its unshot radiosity, S += d, H += K d; of the last second beside it, a "
       "second");
  line("Columns",
       countText(state.measures.rows) +
           (running ? "  (" + countText(static_cast<std::uint64_t>(rates.columns)) + "/s)" : ""),
       "Columns of form factors computed, K of all points for one patch; the others were kept from before. "
       "Of the last second beside it, a second");
  if (state.drawn > 0)
    line("Hemicubes", countText(state.drawn), "Drawn so far: a patch that sees something near takes several");
  line("Unshot light", percentText(state.measures.unshot_fraction),
       "Light that is emitted or reflected but not yet shot: \u2211 A |U| / \u2211 A E over patches and "
       "channels");
  if (state.radius_upper.x < kNoBound) {
    const double low = std::max({state.radius_lower.x, state.radius_lower.y, state.radius_lower.z});
    const double high = std::max({state.radius_upper.x, state.radius_upper.y, state.radius_upper.z});
    line("Spectral radius", figureText(low) + " to " + figureText(high),
         "Of M in B = E + M B, bracketed (largest channel): what a bounce leaves of the light in the long "
         "run");
  }
  const FormFactorDefects& defects = state.estimates.defects;
  if (defects.closure && defects.reciprocity) {
    line("Closure, reciprocity", percentText(*defects.closure) + ", " + percentText(*defects.reciprocity),
         "How far the form factors break two laws of exact ones (RMS, relative): \u2211_j G_ij = 1, all that "
         "a "
         "patch sends arrives or escapes; A_i G_ij = A_j G_ji, the same both ways");
  }
  const std::uint64_t drafts = state.measures.drafts + state.measures.refined;
  if (drafts > 0) {
    line("Drafts refined", countText(state.measures.refined) + " of " + countText(drafts),
         "Patches that see something near shoot one hemicube first, so that the whole picture stands soon; "
         "then each "
         "is split as it should be, and what it has shot is corrected");
  }
  line("Time", durationText(state.measures.seconds) + ", CPU " + durationText(state.measures.cpu_seconds),
       "Of the solve; CPU of the whole program since meshing began");
  line("Form factors kept", memoryText(static_cast<double>(state.kept_bytes)),
       "Memory of the columns that are kept [MB]");
  char frame[32];
  std::snprintf(frame, sizeof frame, "%.1f ms", viewer.frameMilliseconds());
  line("Frame", viewer.frameMilliseconds() > 0 ? frame : "not measured yet",
       "Time to draw the scene and the panels once [ms]; a slow renderer does it over several frames");
  const gl::ContextInfo& gl = viewer.renderer();
  dimmed(gl.renderer + ", " + gl.provider);
}

}  // namespace

int panelWidth(const ViewerState& ui, double scale, int width) {
  if (!ui.panel) return 0;
  const int wanted = static_cast<int>(std::lround(kPanelWidth * scale));
  return width >= leastWindowWithPanel(scale) ? wanted : 0;
}

// Beside a cramped panel there would be no scene.
int leastWindowWithPanel(double scale) { return 2 * static_cast<int>(std::lround(kPanelWidth * scale)); }

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
  warningsSection(viewer);
  pickedSection(viewer);
  probesSection(viewer);
  solveSection(viewer);
  errorsSection(viewer);
  convergenceSection(viewer);
  displaySection(viewer);
  meshSection(viewer);
  cameraSection(viewer);
  sceneSection(viewer);
  materialsSection(viewer);
  bouncesSection(viewer);
  teachingSection(viewer);
  figuresSection(viewer);
  planSection(viewer);
  notesSection(viewer);
  messagesSection(viewer);
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace unshot
