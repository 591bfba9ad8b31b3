#include "viewer/panels/display_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/text.h"
#include "render/display_modes.h"
#include "viewer/panels/false_colour_panel.h"
#include "viewer/panels/reference_picture_panel.h"
#include "viewer/panels/widgets.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr float kHistogramHeight = 5;  // in letters' heights

/// The luminance that is shown as white.
double whitePoint(const Viewer& viewer) {
  return 1 / (viewer.exposure() * std::exp2(viewer.settings().view.exposure_ev));
}

void bars(const LuminanceHistogram& shown, const ImVec2& at, float width, float height) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  double most = 1e-30;
  for (std::size_t k = 0; k < LuminanceHistogram::kBins; ++k)
    most = std::max(most, shown.surfaces[k] + shown.lamps[k]);
  const auto x = [&](std::size_t bin) {
    return at.x + width * static_cast<float>(bin) / LuminanceHistogram::kBins;
  };
  for (std::size_t k = 0; k < LuminanceHistogram::kBins; ++k) {
    const auto rise = [&](double share) { return height * static_cast<float>(share / most); };
    const float bottom = at.y + height, middle = bottom - rise(shown.surfaces[k]);
    list.AddRectFilled({x(k), middle}, {x(k + 1), bottom}, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    list.AddRectFilled({x(k), middle - rise(shown.lamps[k])}, {x(k + 1), middle},
                       ImGui::GetColorU32(ImGuiCol_Text));
  }
}

/// A power of ten under its place, as many as have room.
void decades(const LuminanceHistogram& shown, const ImVec2& at, float width) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  float free_from = at.x - 1;
  for (double decade = shown.low_decade; decade <= shown.high_decade; ++decade) {
    const std::string text = figureText(std::pow(10.0, decade));
    const float size = ImGui::CalcTextSize(text.c_str()).x;
    const float x = at.x + width * static_cast<float>(shown.placeOf(std::pow(10.0, decade)));
    list.AddLine({x, at.y - 0.2f * ImGui::GetFontSize()}, {x, at.y},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled));
    const float left = std::clamp(x - size / 2, at.x, at.x + width - size);
    if (left < free_from) continue;
    list.AddText({left, at.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled), text.c_str());
    free_from = left + size + 0.6f * ImGui::GetFontSize();
  }
}

void whiteLine(double place, const ImVec2& at, float width, float height) {
  const float x = std::round(at.x + width * static_cast<float>(std::clamp(place, 0.0, 1.0)));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = ImGui::GetColorU32(ImGuiCol_PlotLines);
  list.AddLine({x, at.y}, {x, at.y + height}, colour, std::max(1.0f, 0.1f * ImGui::GetFontSize()));
  const char* text = place > 1 ? "white \u203a" : place < 0 ? "\u2039 white" : "white";
  const float size = ImGui::CalcTextSize(text).x, gap = 0.3f * ImGui::GetFontSize();
  const float left = x + gap + size > at.x + width ? x - gap - size : x + gap;
  list.AddText({left, at.y}, colour, text);
}

void histogram(Viewer& viewer) {
  const bool was_open = viewer.settings().histogram;
  ImGui::SetNextItemOpen(was_open);
  const bool open =
      ImGui::TreeNodeEx("Histogram", ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth);
  tooltip(
      "How often which luminance Y = 0.2126 R + 0.7152 G + 0.0722 B is in view, in the unit of what is shown "
      "[W/m\u00b2 of radiosity], by equal steps of its "
      "logarithm: surfaces grey, lamps bright. \"White\" is what the exposure shows as 1");
  if (open != was_open) viewer.perform("histogram", open ? "on" : "off");
  if (!open) return;
  const auto& shown = viewer.histogram();
  if (!shown || shown->empty) {
    ImGui::TextDisabled("nothing bright is in view");
    return;
  }
  const float em = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x,
              height = kHistogramHeight * em;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height},
                                            ImGui::GetColorU32(ImGuiCol_FrameBg), 3);
  bars(*shown, {at.x, at.y + 0.2f * em}, width, height - 0.2f * em);
  decades(*shown, {at.x, at.y + height}, width);
  const double white = whitePoint(viewer);
  const bool toned = displayMode(viewer.settings().view.display).exposed;
  if (toned) whiteLine(shown->placeOf(white), at, width, height);
  ImGui::Dummy({width, height + em});
  if (toned)
    tooltip("White at " + figureText(white) + " [W/m\u00b2, or the unit of what is shown]" +
            (shown->black > 0 ? "; black: " + percentText(shown->black) + " of the pixels" : ""));
}

/// Whether the light that is shown is chosen by what there is to choose.
bool showsLight(const ViewOptions& view) {
  const Quantity quantity = displayMode(view.display).quantity;
  return quantity == Quantity::kRadiosity || quantity == Quantity::kIrradiance ||
         quantity == Quantity::kDifference;
}

/// Which light, and what it is compared with.
void lightChoices(Viewer& viewer) {
  const DisplaySettings& settings = viewer.settings();
  label("Difference", "What the display \"Difference\" compares with");
  ImGui::BeginDisabled(!viewer.state().snapshot);
  if (ImGui::Button("Remember")) viewer.perform("remember");
  ImGui::EndDisabled();
  tooltip(
      "K: the light as it is shown now. The display \"Difference\" then shows how what is shown differs from "
      "it");
  ImGui::SameLine();
  if (const auto reference = settings.view.reference) {  // by value: Forget drops it
    if (ImGui::Button("Forget")) viewer.perform("forget");
    tooltip("Compared with " + reference->name);
  } else {
    if (ImGui::Button("File \u2026##reference")) viewer.perform("browse");
    tooltip(
        "Compared with direct light alone. Ctrl+O: chooses a solution that unshot solve wrote (PLY). Or drop "
        "one on the window");
  }
  ImGui::BeginDisabled(!showsLight(settings.view));
  bool on = settings.view.light.indirect;
  if (ImGui::Checkbox("Radiosity", &on)) viewer.perform("radiosity", on ? "on" : "off");
  tooltip(
      "B: with all light that goes back and forth between surfaces, or without: only what comes straight "
      "from lamps");
  ImGui::EndDisabled();
  ImGui::SameLine(9.0f * ImGui::GetFontSize());
  ImGui::BeginDisabled(!settings.view.light.all() || !showsLight(settings.view));
  on = settings.view.ambient;
  if (ImGui::Checkbox("Ambient term", &on)) viewer.perform("ambient", on ? "on" : "off");
  tooltip(
      "G: adds an estimate of the light still unshot, \u2211 A U / \u2211 A / (1 \u2212 mean \u03c1) "
      "[W/m\u00b2], so that a solve in "
      "its first "
      "moments looks nearly finished. Never part of the solution");
  ImGui::EndDisabled();
}

void brightness(Viewer& viewer) {
  const DisplaySettings& settings = viewer.settings();
  label(
      "Tone curve",
      "From exposed light to the display, where 1 is white. Screenshots have it too; unshot solve draws with "
      "the soft shoulder");
  const std::string& tone = settings.view.tone;
  const DisplayMode& mode = displayMode(settings.view.display);
  const bool toned = mode.tone_mapped && !mode.false_colour;
  ImGui::BeginDisabled(!toned);
  const std::string curve = choose("##tone", toneCurves(), tone, titleOf(toneCurves(), tone), nullptr);
  ImGui::EndDisabled();
  if (!curve.empty()) viewer.perform("tone", curve);
  label("Exposure", "Stops (factors of two) brighter than the automatic exposure; + and \u2212");
  ImGui::BeginDisabled(!mode.exposed);
  float ev = static_cast<float>(settings.view.exposure_ev);
  if (ImGui::SliderFloat("##exposure", &ev, -6, 6, "%+.1f EV")) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", static_cast<double>(ev));
    viewer.perform("exposure", text);
  }
  bool on = settings.exposure_locked;
  if (ImGui::Checkbox("Keep this exposure", &on)) viewer.perform("lock-exposure", on ? "on" : "off");
  tooltip("L: otherwise it follows what is in view");
  ImGui::EndDisabled();
}

}  // namespace

void displaySection(Viewer& viewer) {
  if (!section("Display")) return;
  label("Show", "M: the next one");
  const std::string& shown = viewer.settings().view.display;
  const std::string mode =
      choose("##display", displayModes(), shown, titleOf(displayModes(), shown), nullptr);
  if (!mode.empty()) viewer.perform("display", mode);
  falseColourChoices(viewer);
  lightChoices(viewer);
  referencePictureChoices(viewer);
  brightness(viewer);
  histogram(viewer);
}

}  // namespace unshot
