#include "viewer/panels/error_panel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "viewer/panels/plot.h"
#include "viewer/panels/plot_axes.h"
#include "viewer/panels/race_panel.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

// Bounds above it say nothing: the picture may be black.
constexpr double kMostShown = 1;

// An estimate below this part of its interval's upper end is 0 by noise.
constexpr double kHidden = 1e-3;

double shareOf(double value) { return value > 0 ? std::clamp(1 + std::log10(value) / 4, 0.0, 1.0) : 0.0; }

// A bar on a logarithmic scale from 0.01 % to 100 %, with what it stands for and its value; where `inner` is
// given, a brighter one within it.
void errorBar(const char* name, double value, const std::string& text, const ImVec4& colour,
              std::string_view tip, double inner = 0) {
  label(name, tip);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + width, corner.y + height);
  draw->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), 3);
  const auto fill = [&](double share, const ImVec4& with) {
    if (share <= 0) return;
    draw->AddRectFilled(corner, {corner.x + static_cast<float>(share) * width, end.y},
                        ImGui::GetColorU32(with), 3);
  };
  fill(shareOf(value), colour);
  fill(shareOf(inner), {1.25f * colour.x, 1.25f * colour.y, 1.25f * colour.z, 1});
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  draw->AddText({end.x - size.x - 6, corner.y + (height - size.y) / 2}, ImGui::GetColorU32(ImGuiCol_Text),
                text.c_str());
  ImGui::Dummy({width, height});
  tooltip(tip);
}

/// An estimate and what comes on top of it. Of one that noise hides, its upper end.
std::string aboutText(const ErrorEstimate& e, double more = 0) {
  const bool hidden = e.high > 0 && e.value <= kHidden * e.high;
  return hidden ? "up to " + percentText(more + e.high) : "about " + percentText(more + e.value);
}

std::string estimateText(const ErrorEstimate& e) {
  if (e.places == 0) return "not known yet";
  return percentText(e.value) + " (" + percentText(e.low) + " to " + percentText(e.high) + ")";
}

}  // namespace

std::string solverText(const Measures& m) {
  const bool bounded = m.solverBound() < kMostShown;
  if (!m.true_error) return bounded ? "at most " + percentText(m.solverBound()) : "no bound yet";
  // The bound of the same figure; solverBound() may be that of the total.
  const std::string truth = "true " + shortValueText(*m.true_error, true);
  return m.bounds.upper < kMostShown ? truth + ", below " + shortValueText(m.bounds.upper, true)
                                     : truth + ", no bound yet";
}

std::string knownError(const LaneState& state) {
  if (state.estimates.total.places > 0) return "error " + aboutText(state.estimates.total);
  const double bound = state.measures.solverBound();
  if (bound >= kMostShown) return {};
  const ErrorEstimate& other = state.estimates.both;
  if (other.places == 0) return "solver below " + percentText(bound);
  // A bound that is most of it says how bad it may be, not how it is.
  return "error " +
         (bound > other.high ? "up to " + percentText(bound + other.high) : aboutText(other, bound));
}

std::string errorInFront(const LaneState& state) {
  const std::string known = knownError(state);
  return known.empty() ? percentText(state.measures.unshot_fraction) + " unshot" : known;
}

void errorsSection(Viewer& viewer) {
  const SessionState& state = viewer.state();
  if (!sectionOfLeft("Errors", state)) return;
  const double bound = state.measures.solverBound();
  const std::optional<double>& truth = state.measures.true_error;
  errorBar(
      "Solver", bound < kMostShown ? bound : 0, solverText(state.measures), {0.62f, 0.45f, 0.16f, 1},
      "Distance to the exact solution B* for these form factors, RMS of B \u2212 B* over RMS of B* \u2212 E "
      "[%]: a bound, proven at every step; and once the "
      "mode \"direct\" has solved this system, the true distance, the brighter bar (Again: shoot once more, "
      "in "
      "any mode). The bars are logarithmic, from 0.01 % to 100 %",
      truth.value_or(0));
  errorBar("Form factors", state.estimates.form_factor.value, estimateText(state.estimates.form_factor),
           {0.24f, 0.45f, 0.62f, 1},
           "RMS of \u03c1 (K' \u2212 K) S, carried on by all bounces, over RMS of the reflected light B "
           "\u2212 E [%]: K' "
           "are far denser rays at random places. An estimate with its 95 % interval, refined while nothing "
           "else is to be done");
  errorBar("Mesh", state.estimates.discretisation.value, estimateText(state.estimates.discretisation),
           {0.34f, 0.52f, 0.3f, 1},
           "What the mesh adds to it: RMS of B(x) \u2212 E(x) \u2212 \u03c1 (K' B)(x), the light shown "
           "against the light "
           "gathered at random points x, carried on by all bounces, over RMS of B \u2212 E [%]; less what "
           "the form "
           "factors explain. An estimate with its 95 % interval");
}

namespace {

struct Curves {
  std::vector<PlotPoint> unshot, bound, lower;  // lower: where bound is
};

Curves curvesOf(const LaneState& lane, PlotAxis axis) {
  Curves curves;
  if (!lane.history) return curves;
  curves.unshot.reserve(lane.history->size() + 1);
  const auto add = [&](const Measures& m) {
    const double x = axis == PlotAxis::kSeconds ? m.seconds
                     : axis == PlotAxis::kShots ? static_cast<double>(m.shots)
                                                : static_cast<double>(m.rows);
    curves.unshot.push_back({x, m.unshot_fraction});
    if (m.solverBound() >= kMostShown) return;
    curves.bound.push_back({x, m.solverBound()});
    curves.lower.push_back({x, m.solverLowerBound()});
  };
  for (const HistoryEntry& entry : *lane.history) add(entry.measures);
  add(lane.measures);
  return curves;
}

}  // namespace

void convergenceSection(Viewer& viewer) {
  if (!section("Convergence")) return;
  const SessionState& state = viewer.state();
  const PlotAxis axis = viewer.ui().plot_axis;
  const Curves curves = curvesOf(state, axis), rival = state.rival ? curvesOf(*state.rival, axis) : Curves{};
  PlotStyle style;
  style.name = "unshot";
  style.x_unit = axis == PlotAxis::kSeconds ? "s" : "";
  style.goal = state.facts ? state.facts->solver_target : viewer.ui().options.error;
  style.height = 9 * ImGui::GetFontSize();
  // On the curve's first line, whose left half is free.
  const ImVec2 corner = ImGui::GetCursorPos();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
  if (ImGui::RadioButton("Seconds", axis == PlotAxis::kSeconds)) viewer.perform("plot", "seconds");
  // Close together, for the last value stands at the right.
  ImGui::SameLine(0, 0.3f * ImGui::GetFontSize());
  if (ImGui::RadioButton("Shots", axis == PlotAxis::kShots)) viewer.perform("plot", "shots");
  ImGui::SameLine(0, 0.3f * ImGui::GetFontSize());
  if (ImGui::RadioButton("Rows", axis == PlotAxis::kRows)) viewer.perform("plot", "rows");
  tooltip("Columns and rows of the form factors K computed, those kept from before not counted");
  ImGui::PopStyleVar();
  ImGui::SetCursorPos(corner);
  if (state.rival) {
    style.second = {rival.unshot, "", raceColour(true), true};
  } else {
    style.second = {curves.bound, "bounds of the error", ImGui::GetStyleColorVec4(ImGuiCol_Text), false,
                    curves.lower};
  }
  logPlot("##unshot", curves.unshot, style);
  raceStandings(state);
}

}  // namespace unshot
