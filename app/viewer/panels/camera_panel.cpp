#include "viewer/panels/camera_panel.h"

#include <cstdio>

#include "viewer/panels/widgets.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

std::string number(const char* format, float value) {
  char text[32];
  std::snprintf(text, sizeof text, format, static_cast<double>(value));
  return text;
}

void projection(Viewer& viewer) {
  const bool orthographic = viewer.camera().orthographic;
  label(
      "Projection",
      "O. Perspective: what is twice as far is half as large. Orthographic: all is as large as what lies as "
      "far away as the point looked at, and walls are seen edge-on");
  if (ImGui::BeginCombo("##projection", orthographic ? "Orthographic" : "Perspective")) {
    if (ImGui::Selectable("Perspective", !orthographic)) viewer.perform("projection", "perspective");
    if (ImGui::Selectable("Orthographic", orthographic)) viewer.perform("projection", "orthographic");
    ImGui::EndCombo();
  }
}

void sliders(Viewer& viewer) {
  label("Angle of view", "Vertical angle of view [degrees]; 39.3 is that of the Cornell box as published");
  ImGui::BeginDisabled(viewer.camera().orthographic);
  float angle = static_cast<float>(viewer.camera().fov_deg);
  if (ImGui::SliderFloat("##angle", &angle, 5, 120, "%.1f\u00b0", ImGuiSliderFlags_AlwaysClamp))
    viewer.perform("fov", number("%.4g", angle));
  ImGui::EndDisabled();
  label("Speed",
        "Of flight with W A S D, Q E: 1 crosses the scene in five seconds. Also the wheel while looking "
        "around");
  float speed = static_cast<float>(viewer.navigator().speedFactor());
  if (ImGui::SliderFloat("##speed", &speed, 0.01f, 100, "%.2f",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
    viewer.perform("speed", number("%.4g", speed));
}

void views(Viewer& viewer) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  int column = 0;
  for (const AxisView& view : axisViews()) {
    if (column++ % 3 != 0) ImGui::SameLine();
    if (ImGui::Button(std::string(view.info.title).c_str(), {width, 0}))
      viewer.perform("view", std::string(view.info.key));
    tooltip(view.info.help);
  }
}

}  // namespace

void cameraSection(Viewer& viewer) {
  if (!section("Camera")) return;
  projection(viewer);
  sliders(viewer);
  const std::optional<Bounds> bounds = viewer.boundsInFile();
  ImGui::BeginDisabled(!bounds);
  views(viewer);
  if (bounds) {
    for (const CameraPreset& preset : cameraPresets()) {
      if (!fits(preset, *bounds)) continue;
      if (ImGui::Button(std::string(preset.info.title).c_str(), {-1, 0}))
        viewer.perform("camera-preset", std::string(preset.info.key));
      tooltip(preset.info.help);
    }
  }
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  if (ImGui::Button("Reset view", {width, 0})) viewer.perform("frame");
  tooltip("F: back to the camera chosen for the scene");
  ImGui::SameLine();
  if (ImGui::Button("Copy", {width, 0}))
    viewer.perform("copy-camera", ImGui::GetIO().KeyShift ? "options" : "script");
  tooltip(
      "The camera as lines of a script. With Shift: as options of unshot solve (--eye, --at, --up, --fov), "
      "which "
      "draws in perspective");
  ImGui::EndDisabled();
  ImGui::Spacing();
}

}  // namespace unshot
