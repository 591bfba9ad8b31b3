#include "viewer/panels/reference_picture_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/text.h"
#include "viewer/comparison.h"
#include "viewer/panels/widgets.h"

namespace unshot {
namespace {

constexpr ImGuiWindowFlags kOver = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

void setWipe(Viewer& viewer, double place) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", std::clamp(place, 0.0, 1.0));
  viewer.perform("wipe", text);
}

std::string errorText(const ReferencePicture& picture) {
  return picture.error() ? "RMS difference " + percentText(*picture.error()) : "not compared yet";
}

constexpr const char* kErrorTip =
    "RMS of the difference over RMS of the reference, over pixels and channels, of what is displayed, in "
    "linear values: as unshot "
    "compare does it with two PNG files";

void name(const char* id, const std::string& text, float x, float pivot) {
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({x, 0.7f * em}, ImGuiCond_Always, {pivot, 0});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin(id, nullptr, kOver | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

/// The line between both, to be dragged.
void divider(Viewer& viewer, const ReferencePicture& picture, float width, float bottom) {
  const float em = ImGui::GetFontSize(), grip = em;
  const float x = std::round(static_cast<float>(viewer.ui().wipe) * width);
  const float left = std::clamp(x - grip / 2, 0.0f, std::max(width - grip, 0.0f));
  ImGui::SetNextWindowPos({left, 0});
  ImGui::SetNextWindowSize({grip, bottom});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin("wipe", nullptr,
               kOver | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::InvisibleButton("line", {grip, bottom});
  const bool held = ImGui::IsItemActive(), over = ImGui::IsItemHovered();
  if (held || over) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (held && ImGui::GetIO().MouseDelta.x != 0)
    setWipe(viewer, static_cast<double>(ImGui::GetIO().MousePos.x / width));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = ImGui::GetColorU32(held || over ? ImGuiCol_PlotLines : ImGuiCol_Text);
  const float thick = std::max(1.0f, std::round(0.12f * em));
  list.AddRectFilled({x - thick, 0}, {x + thick, bottom}, IM_COL32(0, 0, 0, 120));
  list.AddRectFilled({x - thick / 2, 0}, {x + thick / 2, bottom}, colour);
  list.AddCircleFilled({left + grip / 2, bottom / 2}, 0.42f * em, colour, 24);
  ImGui::End();
  ImGui::PopStyleVar(2);
  // A name goes where its side is too narrow for it.
  const auto room = [&](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x + 4 * em; };
  if (x > room("Unshot")) name("wipe-ours", "Unshot", x - 0.8f * em, 1);
  if (width - x > room(picture.name())) name("wipe-theirs", picture.name(), x + 0.8f * em, 0);
}

void figure(const ReferencePicture& picture, bool difference, LowerEdge& edge) {
  const float em = ImGui::GetFontSize(), gap = 0.7f * em, width = edge.sceneWidth();
  const std::string error = errorText(picture);
  const float content =
      std::max(ImGui::CalcTextSize(error.c_str()).x, difference ? differenceScaleWidth(width) : 0);
  const float left = width - content - 2 * ImGui::GetStyle().WindowPadding.x - 2 * gap;
  const float bottom = edge.above(left, width);
  ImGui::SetNextWindowPos({width - gap, bottom - gap}, ImGuiCond_Always, {1, 1});
  ImGui::SetNextWindowContentSize({content, 0});  // of this frame: by itself it follows one frame later
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("reference picture", nullptr, kOver | ImGuiWindowFlags_AlwaysAutoResize);
  if (difference) differenceScale("Unshot \u2212 " + picture.name(), "of white", width);
  ImGui::TextUnformatted(error.c_str());
  tooltip(kErrorTip);
  edge.take(left, width, bottom - gap - ImGui::GetWindowHeight());
  ImGui::End();
}

}  // namespace

void referencePictureChoices(Viewer& viewer) {
  const ReferencePicture* picture = viewer.referencePicture();
  label("Compare", kErrorTip);
  if (!picture) {
    if (ImGui::Button("Picture \u2026")) viewer.perform("browse");
    return tooltip(
        "Ctrl+O: chooses a picture (PNG, JPEG, HDR, PFM) of the present camera that is laid over the scene. "
        "Or "
        "drop one on the window");
  }
  bool difference = viewer.ui().picture_difference;
  if (ImGui::Checkbox("Difference##picture", &difference))
    viewer.perform("picture-difference", difference ? "on" : "off");
  tooltip("The difference from " + picture->name() + " as colours, instead of both side by side");
  ImGui::SameLine();
  if (ImGui::Button("Close##picture")) return viewer.perform("forget-picture");
  tooltip("Without the picture " + picture->name());
  label("Wipe",
        "How much of the width shows the scene, the rest shows the reference picture. The line itself can be "
        "dragged");
  ImGui::BeginDisabled(difference);
  auto wipe = static_cast<float>(100 * viewer.ui().wipe);
  if (ImGui::SliderFloat("##wipe", &wipe, 0, 100, "%.0f %%"))
    setWipe(viewer, static_cast<double>(wipe) / 100);
  ImGui::EndDisabled();
}

void buildReferencePicture(Viewer& viewer, float bottom, LowerEdge& edge) {
  const ReferencePicture* picture = viewer.referencePicture();
  if (!picture || edge.sceneWidth() <= 0) return;
  const bool difference = viewer.ui().picture_difference;
  if (!difference) divider(viewer, *picture, edge.sceneWidth(), bottom);
  figure(*picture, difference, edge);
}

}  // namespace unshot
