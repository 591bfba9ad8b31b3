#include "viewer/panels/false_colour_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/text.h"
#include "render/display_modes.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr int kParts = 96;          // of the bar
constexpr float kBarWidth = 17;     // in letters' heights
constexpr float kBarHeight = 0.8f;  // the same

float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

ImU32 colourAt(double place) {
  const glm::vec3 c = falseColourAt(place);
  return ImGui::GetColorU32(ImVec4(encoded(c.x), encoded(c.y), encoded(c.z), 1));
}

const char* unitText(const FalseColour& how) { return how.lumens_per_watt > 0 ? "lux" : "W/m\u00b2"; }

bool isShown(const ViewOptions& view) { return displayMode(view.display).false_colour; }

std::string titleOf(const DisplayMode& mode, const FalseColour& how) {
  if (mode.quantity == Quantity::kFormFactors) return "Form factors, F_ij / A_j [1/m\u00b2]";
  const bool arrives = mode.quantity == Quantity::kIrradiance;
  return std::string(arrives ? "Irradiance H" : "Radiosity B") + " [" + unitText(how) + "]";
}

// Numbers under the bar, as many as have room.
void ticks(const FalseColour& how, double top, const ImVec2& at, float width, float height) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double unit = how.lumens_per_watt > 0 ? how.lumens_per_watt : 1;
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
  float free_from = at.x - ImGui::GetFontSize();
  std::vector<double> values = isolines(top, how);
  if (!how.logarithmic) values.insert(values.begin(), 0.0);
  for (const double value : values) {
    const float x = at.x + width * static_cast<float>(falseColourPlace(value, top, how.logarithmic));
    list.AddLine({x, at.y + height}, {x, at.y + 1.3f * height}, colour);
    const std::string text = figureText(unit * value);
    const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
    if (x - half < free_from) continue;
    list.AddText({x - half, at.y + 1.4f * height}, colour, text.c_str());
    free_from = x + half + 0.5f * ImGui::GetFontSize();
  }
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
        "Unit of the legend. Lux: luminance of the three channels times a luminous efficacy, 683 lm/W of "
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
  if (!isShown(view)) return;
  const bool light = displayMode(view.display).quantity != Quantity::kFormFactors;
  if (light) chooseUnit(viewer);
  bool on = view.false_colour.isolines;
  if (ImGui::Checkbox("Isolines", &on)) viewer.perform("isolines", on ? "on" : "off");
  tooltip("Lines where the legend's values lie");
  if (!light) return;
  ImGui::SameLine(9.0f * ImGui::GetFontSize());
  on = view.false_colour.logarithmic;
  if (ImGui::Checkbox("Logarithmic", &on)) viewer.perform("logarithmic", on ? "on" : "off");
  tooltip("Three decades, instead of from 0 on");
}

void buildFalseColourLegend(const Viewer& viewer, LowerEdge& edge) {
  const ViewOptions& view = viewer.settings().view;
  if (!viewer.shownSnapshot() || !isShown(view)) return;
  const double top = 1 / (viewer.exposure() * std::exp2(view.exposure_ev));
  const float em = ImGui::GetFontSize(), width = std::min(kBarWidth * em, edge.scene_width - 6 * em);
  if (!(width > 4 * em)) return;
  ImGui::SetNextWindowPos({edge.scene_width - 0.7f * em, edge.right - 0.7f * em}, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("false colours", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoInputs);
  const FalseColour how = falseColourOf(view, displayMode(view.display));
  ImGui::TextUnformatted(titleOf(displayMode(view.display), how).c_str());
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 at(corner.x + em, corner.y);  // room for numbers at both ends
  const float height = kBarHeight * em;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int k = 0; k < kParts; ++k) {
    const auto x = [&](int part) { return at.x + width * static_cast<float>(part) / kParts; };
    list.AddRectFilledMultiColor({x(k), at.y}, {x(k + 1), at.y + height}, colourAt(double{1} * k / kParts),
                                 colourAt((k + 1.0) / kParts), colourAt((k + 1.0) / kParts),
                                 colourAt(double{1} * k / kParts));
  }
  ticks(how, top, at, width, height);
  ImGui::Dummy({width + 2 * em, 1.4f * height + em});
  edge.right_width = ImGui::GetWindowWidth() + 0.7f * em;
  edge.right -= ImGui::GetWindowHeight() + 0.7f * em;
  ImGui::End();
}

}  // namespace unshot
