#include "viewer/panels/false_colour_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "render/display_modes.h"
#include "viewer/comparison.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr int kBarParts = 96;       // of the bar
constexpr float kBarWidth = 17;     // in letters' heights
constexpr float kBarHeight = 0.8f;  // the same

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

ImU32 colourOf(const glm::vec3& c) {
  return ImGui::GetColorU32(ImVec4(encoded(c.x), encoded(c.y), encoded(c.z), 1));
}

/// Lux is what arrives; what leaves has no unit of its own.
const char* unitText(const FalseColour& how, Quantity quantity) {
  if (!(how.lumens_per_watt > 0)) return "W/m\u00b2";
  return quantity == Quantity::kIrradiance ? "lux" : "lm/m\u00b2";
}

bool isLegendShown(const ViewOptions& view) { return displayMode(view.display).false_colour; }

/// What stands above the scale, with its unit.
std::string titleOf(const Viewer& viewer, const DisplayMode& mode, const FalseColour& how) {
  const std::string unit = std::string(" [") + unitText(how, mode.quantity) + "]";
  switch (mode.quantity) {
    case Quantity::kFormFactors:
      return "Form factors, G_ij / A_j [1/m\u00b2]";
    case Quantity::kIrradiance:
      return "Irradiance H" + unit;
    case Quantity::kUnshot:
      return "Unshot radiosity U" + unit;
    case Quantity::kBounces:
      return "Expected bounces v [surfaces met]";
    case Quantity::kResidual:
      return "Residual of the mesh, RMS" + unit;
    case Quantity::kLastShot:
      return "What the last step added to B" + unit;
    case Quantity::kDifference:
      return differenceTitle(viewer.state(), viewer.settings().view);
    default:
      return "Radiosity B" + unit;
  }
}

/// Why there is nothing to show; empty where there is.
const char* missingText(const Viewer& viewer, Quantity quantity) {
  const Snapshot& snapshot = *viewer.shownSnapshot();
  if (quantity == Quantity::kBounces && !snapshot.bounces)
    return "not known yet: form factors are missing (section Bounces, Compute them at rest)";
  if (quantity == Quantity::kResidual && !snapshot.residual)
    return "not known yet: estimated once the solve rests";
  const ViewOptions& view = viewer.settings().view;
  if (quantity == Quantity::kFormFactors && !view.form_factors) return "no patch is picked: click a surface";
  if (quantity == Quantity::kLastShot && !view.last_shot) return "no single step was taken: N";
  return "";
}

/// "5e-9" of "5e-09".
std::string shortExponent(std::string text) {
  const std::size_t at = text.find("e-0");
  return at == std::string::npos ? text : text.erase(at + 2, 1);
}

struct LegendTick {
  double place;  ///< 0 left, 1 right
  std::string text;
  /// A power of ten on a logarithmic scale, which comes first where there is little room.
  bool decade = false;
};

std::vector<LegendTick> ticksOf(const DisplayMode& mode, const FalseColour& how, double top) {
  const double unit = how.lumens_per_watt > 0 ? how.lumens_per_watt : 1;
  const auto textOf = [&](double value) {
    return mode.quantity == Quantity::kDifference ? percentText(value)
                                                  : shortExponent(figureText(unit * value));
  };
  std::vector<LegendTick> out;
  const std::vector<double> values = isolines(top, how);
  if (mode.diverging) {
    for (auto value = values.rbegin(); value != values.rend(); ++value)
      out.push_back({(1 - falseColourPlace(*value, top, how.logarithmic)) / 2, "\u2212" + textOf(*value)});
  }
  if (mode.diverging || !how.logarithmic) out.push_back({mode.diverging ? 0.5 : 0, textOf(0)});
  for (const double value : values) {
    const double place = falseColourPlace(value, top, how.logarithmic), digits = std::log10(unit * value);
    out.push_back({mode.diverging ? (1 + place) / 2 : place, textOf(value),
                   how.logarithmic && !mode.diverging && std::abs(digits - std::round(digits)) < 1e-6});
  }
  return out;
}

/// Numbers under the bar, as many as have room: from 0 on, to both sides where it is in the middle.
void drawTicks(const std::vector<LegendTick>& ticks, bool diverging, const ImVec2& at, float width,
               float height) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
  const float gap = 0.5f * ImGui::GetFontSize();
  std::vector<std::pair<float, float>> taken;
  const auto draw = [&](const LegendTick& tick) {
    const float x = at.x + width * static_cast<float>(tick.place);
    list.AddLine({x, at.y + height}, {x, at.y + 1.3f * height}, colour);
    const float half = 0.5f * ImGui::CalcTextSize(tick.text.c_str()).x;
    const bool over = std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
      return x - half < other.second + gap && x + half > other.first - gap;
    });
    if (over) return;
    // Those at the ends stay within the room that there is.
    const float room = ImGui::GetFontSize();
    const float left =
        std::clamp(x - half, at.x - room, std::max(at.x + width + room - 2 * half, at.x - room));
    list.AddText({left, at.y + 1.4f * height}, colour, tick.text.c_str());
    taken.emplace_back(left, left + 2 * half);
  };
  for (const LegendTick& tick : ticks) {
    if (tick.decade) draw(tick);
  }
  const std::size_t middle = diverging ? ticks.size() / 2 : 0;
  for (std::size_t k = middle; k < ticks.size(); ++k) {
    if (!ticks[k].decade) draw(ticks[k]);
    if (k > middle && 2 * middle >= k) draw(ticks[2 * middle - k]);
  }
}

void drawBar(bool diverging, const ImVec2& at, float width, float height) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto colour = [&](double place) {
    return diverging ? colourOf(divergingColourAt(2 * place - 1)) : colourOf(falseColourAt(place));
  };
  for (int k = 0; k < kBarParts; ++k) {
    const auto x = [&](int part) { return at.x + width * static_cast<float>(part) / kBarParts; };
    // Neither end of a part lies beyond the middle, where colours change their kind.
    const ImU32 left = colour((k + 1e-6) / kBarParts), right = colour((k + 1 - 1e-6) / kBarParts);
    list.AddRectFilledMultiColor({x(k), at.y}, {x(k + 1), at.y + height}, left, right, right, left);
  }
}

/// The value where the mouse is, as a number and as a mark on the bar.
void underMouse(const Viewer& viewer, const FalseColour& how, const DisplayMode& mode, double top,
                const ImVec2& at, float width, float height) {
  const std::optional<double>& value = viewer.valueUnderMouse();
  if (!value) {
    ImGui::TextDisabled("point at the scene for its value");
    return;
  }
  const double unit = how.lumens_per_watt > 0 ? how.lumens_per_watt : 1;
  ImGui::TextUnformatted(("under the mouse: " + shortExponent(figureText(unit * *value))).c_str());
  const double place = std::abs(*value) > 0 ? falseColourPlace(std::abs(*value), top, how.logarithmic) : 0;
  const double along = mode.diverging ? (1 + (*value < 0 ? -place : place)) / 2 : place;
  const float x = at.x + width * static_cast<float>(std::clamp(along, 0.0, 1.0)), half = 0.3f * height;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddTriangleFilled({x - half, at.y - half}, {x + half, at.y - half}, {x, at.y + half},
                         ImGui::GetColorU32(ImGuiCol_Text));
  list.AddTriangle({x - half, at.y - half}, {x + half, at.y - half}, {x, at.y + half},
                   IM_COL32(0, 0, 0, 255));
}

void chooseUnit(Viewer& viewer) {
  const ViewOptions& view = viewer.ui().settings.view;
  struct Unit {
    const char* text;
    const char* argument;
  };
  static constexpr std::array<Unit, 3> kUnits = {
      {{"W/m\u00b2", "watts"}, {"lux, 683 lm/W", "683"}, {"lux, 179 lm/W", "179"}}};
  const double efficacy = view.false_colour.lumens_per_watt;
  const std::string shown =
      efficacy > 0 ? "lux, " + figureText(efficacy) + " lm/W" : std::string(kUnits[0].text);
  label("Scale",
        "Unit of the legend. Lux, and lm/m\u00b2 of what leaves surfaces: luminance of the three channels "
        "times a luminous efficacy, 683 lm/W of "
        "green light, or 179 lm/W, what Radiance takes for white. The exposure says where the scale ends");
  if (ImGui::BeginCombo("##unit", shown.c_str())) {
    for (const Unit& unit : kUnits) {
      if (ImGui::Selectable(unit.text, shown == unit.text)) viewer.perform("unit", unit.argument);
    }
    ImGui::EndCombo();
  }
}

}  // namespace

void falseColourChoices(Viewer& viewer) {
  const ViewOptions& view = viewer.ui().settings.view;
  if (!isLegendShown(view)) return;
  const DisplayMode& mode = displayMode(view.display);
  const bool light = mode.quantity != Quantity::kFormFactors && mode.quantity != Quantity::kBounces &&
                     mode.quantity != Quantity::kDifference;
  if (light) chooseUnit(viewer);
  bool on = view.false_colour.isolines;
  if (!mode.diverging) {
    if (ImGui::Checkbox("Isolines", &on)) viewer.perform("isolines", on ? "on" : "off");
    tooltip("Lines where the legend's values lie");
  }
  if (mode.quantity == Quantity::kFormFactors) return;
  if (!mode.diverging) ImGui::SameLine(9.0f * ImGui::GetFontSize());
  on = view.false_colour.logarithmic;
  if (ImGui::Checkbox("Logarithmic", &on)) viewer.perform("logarithmic", on ? "on" : "off");
  tooltip("Three decades, instead of from 0 on");
}

void buildFalseColourLegend(const Viewer& viewer, LowerEdge& edge) {
  const ViewOptions& view = viewer.settings().view;
  const DisplayMode& mode = displayMode(view.display);
  // Signed light in colours of its own has no scale but what is shown as white.
  const bool white = mode.quantity == Quantity::kUnshot && !mode.false_colour;
  if (!viewer.shownSnapshot() || !(mode.false_colour || white)) return;
  const double top = 1 / (viewer.exposure() * std::exp2(view.exposure_ev));
  const float em = ImGui::GetFontSize(), width = std::min(kBarWidth * em, edge.sceneWidth() - 6 * em);
  if (!(width > 4 * em)) return;
  const float right = edge.sceneWidth(), gap = 0.7f * em;
  // With a letter's width on either side for numbers, and its borders.
  const float whole = width + 2 * em + 2 * ImGui::GetStyle().WindowPadding.x + 2 * gap;
  const float bottom = edge.above(right - whole, right);
  ImGui::SetNextWindowPos({right - gap, bottom - gap}, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("false colours", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoInputs);
  const FalseColour how = falseColourOf(view, mode);
  const std::string missing = missingText(viewer, mode.quantity);
  if (white) {
    wrapped("Unshot radiosity U: white at " + figureText(top) + " W/m\u00b2, blue below 0", width + 2 * em);
  } else if (!missing.empty()) {
    wrapped(titleOf(viewer, mode, how) + ": " + missing, width + 2 * em);
  } else {
    wrapped(titleOf(viewer, mode, how), width + 2 * em);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 at(corner.x + em, corner.y);  // room for numbers at both ends
    const float height = kBarHeight * em;
    drawBar(mode.diverging, at, width, height);
    drawTicks(ticksOf(mode, how, top), mode.diverging, at, width, height);
    ImGui::Dummy({width + 2 * em, 1.4f * height + em});
    if (ValueProbe::reads(mode.quantity)) underMouse(viewer, how, mode, top, at, width, height);
  }
  edge.take(right - whole, right, bottom - gap - ImGui::GetWindowHeight());
  ImGui::End();
}

}  // namespace unshot
