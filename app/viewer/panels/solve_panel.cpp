#include "viewer/panels/solve_panel.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/text.h"
#include "formfactor/methods.h"
#include "mesh/build.h"
#include "solver/modes.h"
#include "viewer/panels/race_panel.h"
#include "viewer/panels/widgets.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

/// The title of what is in use: with `auto` what that became, once it is known.
template <class Row>
std::string shownChoice(std::span<const Row> table, const std::string& asked, const std::string& became) {
  if (asked != "auto") return titleOf(table, asked);
  return became.empty() ? "Automatic" : titleOf(table, became);
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
        "below this. On an even mesh that is the solver's error alone: what mesh and form factors add is "
        "estimated beside it, and \"error about\" is of all. A smaller one goes on from there, on a finer "
        "mesh where that follows the light");
  const double error = viewer.ui().options.error;
  const std::shared_ptr<const Snapshot>& snapshot = viewer.state().snapshot;
  const char* const of_what = snapshot && !snapshot->mesh->for_error ? " solver error" : " error";
  if (!ImGui::BeginCombo("##error", (percentText(error) + of_what).c_str())) return;
  for (const Choice& choice : kChoices) {
    if (ImGui::Selectable((percentText(choice.error) + " error").c_str(), choice.error == error))
      viewer.perform("error", choice.key);
  }
  ImGui::EndCombo();
}

}  // namespace

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
       "Number of patches, which shoot, and of elements, which receive, on lit sides");
  line("Element size", figureText(state.snapshot->mesh->element_size) + " m",
       "Edge of a full cell aimed at [m]; cells beside borders, contacts and small lamps are smaller");
  line("Surfaces", countText(state.facts->surfaces),
       "Number of surfaces: polygons of one material in one plane are one where they join");
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
       "How often a patch has shot its unshot radiosity, S += d, H += K d; beside it those of the last "
       "second [1/s]");
  line("Columns",
       countText(state.measures.rows) +
           (running ? "  (" + countText(static_cast<std::uint64_t>(rates.columns)) + "/s)" : ""),
       "Number of columns of form factors computed, K of all points for one patch; the others were kept from "
       "before. Beside it those of the last second [1/s]");
  if (state.drawn > 0)
    line("Hemicubes", countText(state.drawn),
         "Number of those drawn so far: a patch that sees something near takes several");
  line("Unshot light", percentText(state.measures.unshot_fraction),
       "Light that is emitted or reflected but not yet shot: \u2211 A |U| / \u2211 A E over patches and "
       "channels [%]");
  if (state.radius_upper.x < kNoBound) {
    const double low = std::max({state.radius_lower.x, state.radius_lower.y, state.radius_lower.z});
    const double high = std::max({state.radius_upper.x, state.radius_upper.y, state.radius_upper.z});
    line("Spectral radius", figureText(low) + " to " + figureText(high),
         "The largest |\u03bb| of M v = \u03bb v in B = E + M B, between bounds (largest channel): what a "
         "bounce "
         "leaves of the light in the long run");
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
         "Number of patches: those that see something near shoot one hemicube first, so that the whole "
         "picture stands soon; "
         "then each "
         "is split as it should be, and what it has shot is corrected");
  }
  line("Time", durationText(state.measures.seconds) + ", CPU " + durationText(state.measures.cpu_seconds),
       "Of the solve [s]; CPU of the whole program since meshing began [s]");
  line("Form factors kept", memoryText(static_cast<double>(state.kept_bytes)),
       "Memory of the columns that are kept [MB]");
  char frame[32];
  std::snprintf(frame, sizeof frame, "%.1f ms", viewer.frameMilliseconds());
  line("Frame", viewer.frameMilliseconds() > 0 ? frame : "not measured yet",
       "Time to draw the scene and the panels once [ms]; a slow renderer does it over several frames");
  const gl::ContextInfo& gl = viewer.renderer();
  dimmed(gl.renderer + ", " + gl.provider);
  tooltip("What draws the picture, and the provider of OpenGL that it was reached by");
}

}  // namespace unshot
