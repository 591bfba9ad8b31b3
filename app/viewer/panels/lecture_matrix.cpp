// The lecture's matrix page: M = R G gathered to groups, its powers and partial sums, and how the series
// grows.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/srgb.h"
#include "base/text.h"
#include "render/false_colour.h"
#include "viewer/comparison.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/panels/widgets.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

constexpr double kBytesOfEntry = 8;            // double precision
constexpr double kColourDecades = 4;           // that the heat map's colours go over
constexpr float kLegend = 0.7f, kBars = 4.5f;  // heights in letters
constexpr float kWideLine = 30;                // has room for all choices of the matrix, in letters' heights
constexpr std::size_t kTermsShown = 24;
constexpr ImU32 kNotComputed = IM_COL32(62, 64, 70, 255);
const ImVec4 kRed{1.0f, 0.38f, 0.33f, 1};

ImU32 colourAt(double place) {
  static const std::array<ImU32, 256> kColours = [] {
    std::array<ImU32, 256> out{};
    for (std::size_t k = 0; k < out.size(); ++k) {
      const glm::vec3 c = falseColourAt(static_cast<double>(k) / 255);
      out[k] = IM_COL32(srgb8FromLinear(c.x), srgb8FromLinear(c.y), srgb8FromLinear(c.z), 255);
    }
    return out;
  }();
  return kColours[static_cast<std::size_t>(std::lround(255 * std::clamp(place, 0.0, 1.0)))];
}

ImU32 heatColour(double value, double most) {
  if (!(value > 0) || !(most > 0)) return IM_COL32(18, 18, 20, 255);
  // Above 0 nothing is as dark as 0.
  return colourAt(0.08 + 0.92 * std::clamp(1 + std::log10(value / most) / kColourDecades, 0.0, 1.0));
}

std::string groupText(const GatheredMatrix& m, const Mesh& mesh, std::size_t k) {
  const GatheredMatrix::Group& group = m.groups[k];
  if (group.sky) return "the sky";
  const std::string name =
      group.several_materials ? "several materials" : mesh.materials[group.material].name;
  const std::string surface =
      group.side == kNone ? "" : ", surface " + std::to_string(mesh.sides[group.side].surface);
  return name + surface + " (" + countedText(group.patches, "patch", "patches") + ", " +
         figureText(group.area) + " m\u00b2)";
}

std::string powerText(std::size_t k) {
  if (k == 0) return "I";
  return k == 1 ? "M" : "M" + superscript(k);
}

/// What a cell's number is called.
std::string termText(std::size_t k, bool sums) {
  if (!sums) return powerText(k);
  std::string out = "I";
  if (k > 3) return "I + M + \u2026 + " + powerText(k);
  for (std::size_t t = 1; t <= k; ++t) out += " + " + powerText(t);
  return out;
}

using MatrixCell = std::pair<std::size_t, std::size_t>;  // row and column

std::string cellText(const Viewer& viewer, const std::vector<double>& values, const std::string& name,
                     const MatrixCell& cell) {
  const auto [i, j] = cell;
  const Teaching& teaching = viewer.teaching();
  const GatheredMatrix& m = *teaching.insight()->matrix;
  const Mesh& mesh = *viewer.state().snapshot->mesh;
  std::string text = "from j: " + groupText(m, mesh, j) + "\nto i: " + groupText(m, mesh, i) + "\n";
  text += name + " there: " + channelText(values[i * m.size() + j]);
  text += "\nR_i = " + channelText(teaching.reflectance(i)) + ", G_ij = " + channelText(m.factor(i, j)) +
          ", R_i G_ij = " + channelText(teaching.transport(i, j));
  if (!m.groups[j].sends) text += "\nj holds no light: what it would send was not computed";
  return text;
}

void markGroups(Teaching& teaching, const MatrixCell& cell) {
  teaching.markGroup(static_cast<std::uint32_t>(cell.second), true);
  teaching.markGroup(static_cast<std::uint32_t>(cell.first), false);
}

/// The one that an action has chosen, where the matrix has it.
std::optional<MatrixCell> chosenCell(const Teaching& teaching) {
  const std::size_t n = teaching.insight()->matrix->size();
  const std::optional<MatrixCell>& cell = teaching.choices.cell;
  return cell && cell->first < n && cell->second < n ? cell : std::nullopt;
}

/// A square of cells, `side` pixels wide.
void heatMap(Viewer& viewer, const char* id, const std::vector<double>& values, const std::string& name,
             float side) {
  const std::vector<GatheredMatrix::Group>& groups = viewer.teaching().insight()->matrix->groups;
  const std::size_t n = groups.size();
  const double most = *std::max_element(values.begin(), values.end());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::InvisibleButton(id, {side, side});
  const auto edge = [&](float from, std::size_t k) {
    return from + std::round(side * static_cast<float>(k) / static_cast<float>(n));
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      list.AddRectFilled({edge(at.x, j), edge(at.y, i)}, {edge(at.x, j + 1), edge(at.y, i + 1)},
                         groups[j].sends ? heatColour(values[i * n + j], most) : kNotComputed);
  }
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetMousePos();
  const auto under = [&](float from, float to) {
    return std::min(n - 1,
                    static_cast<std::size_t>(std::max(0.0f, (to - from) / side) * static_cast<float>(n)));
  };
  const std::optional<MatrixCell> cell =
      hovered ? std::optional<MatrixCell>({under(at.y, mouse.y), under(at.x, mouse.x)})
              : chosenCell(viewer.teaching());
  if (!cell) return;
  const auto [i, j] = *cell;
  list.AddRect({edge(at.x, j) - 1, edge(at.y, i) - 1}, {edge(at.x, j + 1) + 1, edge(at.y, i + 1) + 1},
               IM_COL32(255, 255, 255, 255));
  if (!hovered) return;
  tooltip(cellText(viewer, values, name, *cell));
  markGroups(viewer.teaching(), *cell);
}

void legend(double most, float width) {
  const float em = ImGui::GetFontSize(), height = kLegend * em;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  constexpr int kParts = 64;
  for (int k = 0; k < kParts; ++k) {
    const double value = most * std::pow(10.0, kColourDecades * (static_cast<double>(k) / (kParts - 1) - 1));
    list.AddRectFilled({at.x + width * static_cast<float>(k) / kParts, at.y},
                       {at.x + width * static_cast<float>(k + 1) / kParts, at.y + height},
                       heatColour(value, most));
  }
  const std::string low = channelText(most * std::pow(10.0, -kColourDecades)), high = channelText(most);
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  list.AddText({at.x, at.y + 1.15f * height}, text, low.c_str());
  list.AddText({at.x + width - ImGui::CalcTextSize(high.c_str()).x, at.y + 1.15f * height}, text,
               high.c_str());
  ImGui::Dummy({width, height + 1.3f * em});
}

void map(Viewer& viewer, const char* id, const std::vector<double>& values, const std::string& name,
         float side) {
  ImGui::BeginGroup();
  ImGui::TextUnformatted(name.c_str());
  heatMap(viewer, id, values, name, side);
  legend(*std::max_element(values.begin(), values.end()), side);
  ImGui::EndGroup();
}

void chooseChannel(Viewer& viewer) {
  static constexpr std::array<const char*, 3> kNames = {"red", "green", "blue"};
  for (int c = 0; c < 3; ++c) {
    if (c > 0) ImGui::SameLine();
    if (ImGui::RadioButton(kNames[static_cast<std::size_t>(c)], viewer.teaching().choices.channel == c))
      viewer.perform("matrix-channel", kNames[static_cast<std::size_t>(c)]);
    tooltip("The channel whose reflectance R is in M = R G");
  }
}

void choosePower(Viewer& viewer) {
  const TeachingChoices& choices = viewer.teaching().choices;
  int k = static_cast<int>(choices.power);
  ImGui::SetNextItemWidth(9 * ImGui::GetFontSize());
  if (ImGui::SliderInt("##power", &k, 0, static_cast<int>(MatrixSeries::kMost), "k = %d",
                       ImGuiSliderFlags_AlwaysClamp))
    viewer.perform("matrix-power", std::to_string(k));
  tooltip("The power M^k, light after k bounces, or the sum of all up to it");
  ImGui::SameLine();
  bool sums = choices.sums;
  if (ImGui::Checkbox("partial sum", &sums)) viewer.perform("matrix-sums", sums ? "on" : "off");
  tooltip("I + M + \u2026 + M^k, which tends to (I \u2212 M)\u207b\u00b9, instead of M^k");
}

std::string twoDigits(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

void chooseReflectance(Viewer& viewer) {
  const TeachingChoices& choices = viewer.teaching().choices;
  bool on = choices.allow_divergence;
  if (ImGui::Checkbox("Allow divergence", &on)) viewer.perform("allow-divergence", on ? "on" : "off");
  tooltip(
      "Other reflectances, also 1 and more, to see when the series grows. In this small matrix alone: the "
      "solve stays as it is, with 1 at most");
  if (!choices.allow_divergence) return;
  const bool beside = ImGui::GetContentRegionAvail().x > kWideLine * ImGui::GetFontSize();
  if (beside) ImGui::SameLine();
  if (ImGui::RadioButton("own R", !choices.alike)) viewer.perform("matrix-factor", twoDigits(choices.factor));
  tooltip("Each group's own R times a factor");
  ImGui::SameLine();
  if (ImGui::RadioButton("every R", choices.alike))
    viewer.perform("matrix-reflectance", twoDigits(choices.reflectance));
  tooltip("The same R for all groups");
  if (beside) ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (choices.alike) {
    float r = static_cast<float>(choices.reflectance);
    if (ImGui::SliderFloat("##reflectance", &r, 0.5f, 2, "every R = %.2f", ImGuiSliderFlags_AlwaysClamp))
      viewer.perform("matrix-reflectance", twoDigits(static_cast<double>(r)));
    tooltip("R of every group in M = R G, 0.5 to 2: above 1 the terms of the series may grow");
  } else {
    float factor = static_cast<float>(choices.factor);
    if (ImGui::SliderFloat("##factor", &factor, 0.5f, 10, "own R \u00d7 %.2f",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
      viewer.perform("matrix-factor", twoDigits(static_cast<double>(factor)));
    tooltip(
        "f in M = f R G, 0.5 to 10, R being each group's own: the terms of the series grow once f times the "
        "spectral radius is above 1");
  }
}

/// Bars of the norms of M^k, logarithmic; red where the series has no sum.
void terms(Viewer& viewer) {
  Teaching& teaching = viewer.teaching();
  MatrixSeries& series = teaching.series();
  const bool endless = series.terms() != SeriesTerms::kShrink;
  const float em = ImGui::GetFontSize(), height = kBars * em,
              width = std::floor(ImGui::GetContentRegionAvail().x);
  ImGui::TextUnformatted("Size of the terms M^k, each line a tenth");
  tooltip(
      "The largest row sum of M^k: what k bounces make of a radiosity of 1 everywhere, at most. The scale is "
      "logarithmic, from one line to the next ten times as much: what grows or falls by the same factor with "
      "each bounce makes a straight row");
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##terms", {width, height + 1.1f * em});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  double most = 1;
  for (std::size_t k = 0; k <= kTermsShown; ++k) most = std::max(most, series.norm(k));
  const double decades = std::max(3.0, std::ceil(std::log10(most)) + 3), top = std::log10(most);
  const float slot = width / static_cast<float>(kTermsShown + 1);
  for (double decade = std::floor(top); decade > top - decades; --decade) {
    const float y = at.y + height * static_cast<float>((top - decade) / decades);
    list.AddRectFilled({at.x, y}, {at.x + width, y + 1}, ImGui::GetColorU32(ImGuiCol_Text, 0.15f));
  }
  for (std::size_t k = 0; k <= kTermsShown; ++k) {
    const double size = series.norm(k);
    const double share = size > 0 ? std::clamp(1 + (std::log10(size) - top) / decades, 0.0, 1.0) : 0;
    const float x = at.x + slot * static_cast<float>(k);
    const ImVec4 colour = endless ? kRed : ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram);
    const bool lit = !teaching.choices.sums ? k == teaching.choices.power : k <= teaching.choices.power;
    list.AddRectFilled({x, at.y + height * static_cast<float>(1 - share)}, {x + slot - 2, at.y + height},
                       ImGui::GetColorU32({colour.x, colour.y, colour.z, lit ? 1.0f : 0.45f}));
    if (k % 4 == 0)
      list.AddText({x, at.y + height + 1}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                   std::to_string(k).c_str());
  }
  list.AddRectFilled({at.x, at.y + height}, {at.x + width, at.y + height + 1},
                     ImGui::GetColorU32(ImGuiCol_Text, 0.35f));
  // Two of the upper lines, as near to each other as there is room, with what they stand for.
  const double apart = std::max(1.0, std::ceil(1.2 * static_cast<double>(em / height) * decades));
  for (double decade = std::floor(top); decade > std::floor(top) - 2 * apart; decade -= apart) {
    const std::string text = channelText(std::pow(10.0, decade));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner{at.x + width - size.x - 2,
                        at.y + height * static_cast<float>((top - decade) / decades)};
    list.AddRectFilled({corner.x - 3, corner.y}, {corner.x + size.x + 2, corner.y + size.y},
                       ImGui::GetColorU32(ImGuiCol_WindowBg, 0.8f));
    list.AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  }
  if (!ImGui::IsItemHovered()) return;
  const float place = (ImGui::GetMousePos().x - at.x) / slot;
  const auto k = std::min(kTermsShown, static_cast<std::size_t>(std::max(0.0f, place)));
  tooltip(termText(k, false) + ": " + channelText(series.norm(k)));
  if (ImGui::IsItemClicked()) viewer.perform("matrix-power", std::to_string(k));
}

std::string_view termsText(SeriesTerms terms) {
  switch (terms) {
    case SeriesTerms::kGrow:
      return ". Each bounce adds more than the one before: the series has no sum, for walls that "
             "return more light than they get never come to rest";
    case SeriesTerms::kStay:
      return ". Each bounce adds as much as the one before and the sum grows without end, for where nothing "
             "is absorbed light never ends";
    case SeriesTerms::kShrink:
      break;
  }
  return ": what each further bounce leaves of the light, in the long run";
}

void radiusLine(Viewer& viewer) {
  const MatrixSeries& series = viewer.teaching().series();
  const bool endless = series.terms() != SeriesTerms::kShrink;
  if (endless) ImGui::PushStyleColor(ImGuiCol_Text, kRed);
  wrapped("Spectral radius of M: " + figureText(series.radius()) + std::string(termsText(series.terms())));
  if (endless) ImGui::PopStyleColor();
  tooltip("The largest |\u03bb| of M v = \u03bb v: M^k tends to 0 where it is below 1");
  const TeachingChoices& choices = viewer.teaching().choices;
  if (!choices.allow_divergence || !(series.radius() > 0)) return;
  const double limit = (choices.alike ? choices.reflectance : choices.factor) / series.radius();
  dimmed((choices.alike ? "It is 1 with every R = " : "It is 1 with own R \u00d7 ") + figureText(limit));
}

/// How near the partial sum is to what the solve has.
void lightLine(Viewer& viewer) {
  Teaching& teaching = viewer.teaching();
  if (teaching.choices.allow_divergence) return;
  const std::vector<double> light = teaching.series().light(teaching.emission(), teaching.choices.power);
  const std::vector<double> solved = teaching.solution();
  const auto& groups = teaching.insight()->matrix->groups;
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].sky) continue;
    sum += groups[i].area * light[i];
    all += groups[i].area * solved[i];
  }
  if (!(all > 0)) return;
  wrapped("B = (" + termText(teaching.choices.power, true) + ") E: " + percentText(sum / all) +
          " of the power of " +
          (viewer.state().phase == SessionPhase::kConverged ? "the solve's B" : "what is shot so far"));
  tooltip(
      "\u2211 A B over the groups. At the end it misses the solve's by as much as gathering costs: within a "
      "group all patches count as equally bright");
}

void memoryLine(Viewer& viewer) {
  const SessionState& state = viewer.state();
  const auto n = static_cast<double>(state.facts->elements);
  wrapped("M of all " + countText(state.facts->elements) + " elements would take " +
          memoryText(kBytesOfEntry * n * n) +
          "; form factors kept: " + memoryText(static_cast<double>(state.kept_bytes)));
  tooltip(
      "Elements squared, 8 bytes each: each element on its own. The solver keeps columns of form factors for "
      "patches of "
      "several elements, those that it has shot along, 4 bytes an element and only where light arrives; M "
      "itself is never made");
}

void computeMissing(Viewer& viewer) {
  if (viewer.state().snapshot->bounce_wait.no_room) {
    dimmed("There is no room to keep them.");
    return;
  }
  if (ImGui::Button("Compute them at rest")) viewer.perform("complete-bounces");
  tooltip("Computes the form factors of all patches that hold light");
}

/// Where there is no matrix, why.
void missing(Viewer& viewer) {
  const SessionState& state = viewer.state();
  const Snapshot& snapshot = *state.snapshot;
  const bool running = state.phase == SessionPhase::kRunning;
  if (running) {
    wrapped("M is gathered from the form factors at hand when the solve rests.");
    if (ImGui::Button("Pause")) viewer.perform("pause", "on");
    tooltip("Space");
    return;
  }
  if (state.measures.shots == 0) {
    const char* dark = "Nothing of this scene emits light: nothing is shot, and M has no form factors.";
    const char* early = "M is gathered from the form factors of shots: none was shot yet.";
    wrapped(state.stopped_by == "no light" ? dark : early);
    return;
  }
  const std::string wait = bounceWaitText(state);
  if (wait.empty() || snapshot.bounce_wait.columns == 0) {
    dimmed("M is being gathered \u2026");
    return;
  }
  wrapped(wait + ".");
  computeMissing(viewer);
}

}  // namespace

void matrixPage(Viewer& viewer) {
  Teaching& teaching = viewer.teaching();
  if (!viewer.state().snapshot) {
    dimmed("nothing yet");
    return;
  }
  const Insight* insight = teaching.insight();
  if (!insight || !insight->matrix || insight->matrix->size() == 0) {
    missing(viewer);
    return;
  }
  const GatheredMatrix& m = *insight->matrix;
  wrapped("M = R G of " + countText(m.group.size()) + " patches in " + countText(m.size()) +
          " groups: row i receives, column j sends. B = E + M B");
  tooltip(
      "R_i G_ij: the part of group j's radiosity that group i reflects, by the solver's own form factors, "
      "means "
      "over areas. Patches of a group lie together on one side of a surface as far as that many groups "
      "allow");
  if (m.missing > 0) {
    dimmed(countedText(m.missing, "column") + " of form factors are missing and count as nothing.");
    computeMissing(viewer);
  }
  const float em = ImGui::GetFontSize();
  const bool wide = ImGui::GetContentRegionAvail().x > kWideLine * em;
  chooseChannel(viewer);
  if (wide) ImGui::SameLine();
  choosePower(viewer);
  chooseReflectance(viewer);
  const TeachingChoices& choices = teaching.choices;
  MatrixSeries& series = teaching.series();
  const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
  const bool beside = room > 20 * em;
  const float side = std::floor(beside ? (room - 2 * gap) / 2 : room);
  map(viewer, "##M", series.power(1), "M = R G", side);
  if (beside) ImGui::SameLine(0, 2 * gap);
  const std::vector<double>& other = choices.sums ? series.sum(choices.power) : series.power(choices.power);
  const std::string name = termText(choices.power, choices.sums);
  map(viewer, "##other", other, name, side);
  const auto& groups = teaching.insight()->matrix->groups;
  if (std::any_of(groups.begin(), groups.end(), [](const auto& group) { return !group.sends; }))
    dimmed("Black: 0. Grey columns are not computed: no light leaves there.");
  if (const std::optional<MatrixCell> cell = chosenCell(teaching)) {
    wrapped(cellText(viewer, other, name, *cell));
    markGroups(teaching, *cell);
  }
  radiusLine(viewer);
  terms(viewer);
  lightLine(viewer);
  memoryLine(viewer);
}

}  // namespace unshot
