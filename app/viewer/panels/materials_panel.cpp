#include "viewer/panels/materials_panel.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr float kLeastStrength = 1e-3f, kMostStrength = 1e4f;  // of the slider [W/m^2]

using Colour = std::array<float, 3>;

Colour floats(const glm::dvec3& value) {
  return {static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)};
}

glm::dvec3 doubles(const Colour& value) { return {value[0], value[1], value[2]}; }

double strengthOf(const glm::dvec3& e) { return std::max({e.x, e.y, e.z}); }

std::string colourText(const glm::dvec3& value) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6g,%.6g,%.6g", value.x, value.y, value.z);
  return text;
}

void swatch(const Material& m) {
  const double strength = strengthOf(m.emission);
  const glm::dvec3 shown = m.emits() ? m.emission / strength : m.reflectance;
  const float size = ImGui::GetTextLineHeight();
  ImGui::ColorButton(
      "##swatch", {static_cast<float>(shown.x), static_cast<float>(shown.y), static_cast<float>(shown.z), 1},
      ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop, {size, size});
  ImGui::SameLine();
}

void chooseMaterial(Viewer& viewer, const MaterialEdits::Materials& materials) {
  const std::size_t chosen = viewer.ui().material;
  label("Material", "What surfaces of the scene are made of");
  if (!ImGui::BeginCombo("##material", materials[chosen].name.c_str(), ImGuiComboFlags_HeightLarge)) return;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    ImGui::PushID(static_cast<int>(m));
    swatch(materials[m]);
    const std::string text = materials[m].name + (materials[m].emits() ? "  (light)" : "");
    if (ImGui::Selectable(text.c_str(), m == chosen)) viewer.perform("material", materials[m].name);
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

bool editColour(const char* id, Colour& colour) {
  return ImGui::ColorEdit3(
      id, colour.data(),
      ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoOptions | ImGuiColorEditFlags_PickerHueWheel);
}

void editMaterial(Viewer& viewer, const Material& m) {
  label("Reflects",
        "Reflectance \u03c1, 0 to 1 per channel: what part of the light that arrives leaves again, B = "
        "E + \u03c1 H. The solution follows by shooting the difference");
  Colour rho = floats(m.reflectance);
  if (editColour("##reflects", rho)) viewer.perform("reflectance", m.name + " " + colourText(doubles(rho)));
  label("Emits", "Whether it is a light: what is switched on again emits what it did");
  bool on = m.emits();
  if (ImGui::Checkbox("##light", &on)) viewer.perform("light", m.name + (on ? " on" : " off"));
  if (!m.emits()) return;
  const double strength = strengthOf(m.emission);
  label("Colour", "Of its emission, E over its strongest channel: 0 to 1");
  Colour colour = floats(m.emission / strength);
  const bool edited = editColour("##colour", colour);
  // A colour alone: darker is for the slider, and black is none.
  if (const double most = strengthOf(doubles(colour)); edited && most > 0)
    viewer.perform("emission", m.name + " " + colourText(strength / most * doubles(colour)));
  label("Strength", "Emission E [W/m\u00b2] of its strongest channel: what leaves a square metre of it");
  float value = static_cast<float>(strength);
  if (ImGui::SliderFloat("##strength", &value, kLeastStrength, kMostStrength, "%.3g W/m\u00b2",
                         ImGuiSliderFlags_Logarithmic))
    viewer.perform("emission", m.name + " " + colourText(static_cast<double>(value) / strength * m.emission));
}

void editButtons(Viewer& viewer) {
  const MaterialEdits& edits = viewer.edits();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const auto textWidth = [](const char* text) {
    return ImGui::CalcTextSize(text).x + 2 * ImGui::GetStyle().FramePadding.x;
  };
  const float texts = textWidth("Undo") + textWidth("Redo") + textWidth("Reset") + textWidth("Save MTL");
  const float spare = std::max((ImGui::GetContentRegionAvail().x - 3 * gap - texts) / 4, 0.0f);
  const auto button = [&](const char* text, const char* action, bool enabled, const char* tip) {
    ImGui::BeginDisabled(!enabled);
    if (ImGui::Button(text, {textWidth(text) + spare, 0})) viewer.perform(action);
    tooltip(tip);
    ImGui::EndDisabled();
  };
  button("Undo", "undo", edits.canUndo(), "Ctrl+Z: takes the last change back");
  ImGui::SameLine();
  button("Redo", "redo", edits.canRedo(), "Ctrl+Y: makes it again");
  ImGui::SameLine();
  button("Reset", "reset-materials", edits.edited(), "All materials as the scene was opened; can be undone");
  ImGui::SameLine();
  button("Save MTL", "save-materials", true,
         "Writes reflectance and emission of all materials into a new MTL file in the working folder; the "
         "scene's "
         "own files stay as they are");
}

}  // namespace

void materialsSection(Viewer& viewer) {
  const MaterialEdits::Materials& materials = viewer.edits().materials();
  if (materials.empty()) return;
  ViewerState& ui = viewer.ui();
  ui.material = std::min(ui.material, materials.size() - 1);
  ImGui::SetNextItemOpen(ui.materials);
  const bool open = ImGui::CollapsingHeader(viewer.edits().edited() ? "Materials (edited)###materials"
                                                                    : "Materials###materials");
  if (open != ui.materials) viewer.perform("materials", open ? "on" : "off");
  if (!open) return;
  chooseMaterial(viewer, materials);
  const Material chosen = materials[ui.material];  // an edit changes what is in the list
  editMaterial(viewer, chosen);
  editButtons(viewer);
}

}  // namespace unshot
