#include "viewer/panels/lecture_panel.h"

#include <algorithm>
#include <cmath>

#include "viewer/panels/marks.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/widgets.h"
#include "viewer/teaching.h"

namespace unshot {
namespace {

// At scale 1 [px]: its width, what its lines take at least, and how much of the scene is left beside both
// panels.
constexpr double kWidth = 540, kLeastWidth = 316, kLeastScene = 480;
constexpr double kMostOfWindow = 0.62;  // of the window, where that is small

void page(Viewer& viewer, LecturePage shown) {
  switch (shown) {
    case LecturePage::kMatrix:
      return matrixPage(viewer);
    case LecturePage::kEquation:
      return equationPage(viewer);
    case LecturePage::kShots:
      return shotsPage(viewer);
    case LecturePage::kEffects:
      return effectsPage();
  }
}

/// The pages' names, over as many lines as they take, and what closes all of it.
void tabs(Viewer& viewer) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const auto widthOf = [&](const char* text) {
    return ImGui::CalcTextSize(text).x + 2 * style.FramePadding.x;
  };
  const ImVec2 start = ImGui::GetCursorPos();
  const float close = ImGui::GetContentRegionMax().x - widthOf("\u00d7");
  ImGui::SetCursorPosX(close);
  if (ImGui::Button("\u00d7")) viewer.perform("lecture", "off");
  tooltip("T: closes the lecture");
  ImGui::SetCursorPos(start);
  const LecturePage shown = viewer.teaching().choices.page;
  float right = start.x;
  for (const LecturePageRow& row : lecturePages()) {
    const std::string title(row.info.title);
    const float width = widthOf(title.c_str());
    const bool fits = right + style.ItemSpacing.x + width <= close - style.ItemSpacing.x;
    if (row.page != LecturePage::kMatrix && fits) ImGui::SameLine();
    right = row.page != LecturePage::kMatrix && fits ? right + style.ItemSpacing.x + width : start.x + width;
    const bool present = row.page == shown;
    ImGui::PushStyleColor(ImGuiCol_Button,
                          ImGui::GetStyleColorVec4(present ? ImGuiCol_TabActive : ImGuiCol_WindowBg));
    ImGui::PushStyleColor(ImGuiCol_Text,
                          ImGui::GetStyleColorVec4(present ? ImGuiCol_PlotLines : ImGuiCol_Text));
    if (ImGui::Button(title.c_str())) viewer.perform("lecture-page", std::string(row.info.key));
    ImGui::PopStyleColor(2);
    tooltip(row.info.help);
  }
}

}  // namespace

bool lectureShowsHemicube(const Viewer& viewer) {
  const TeachingChoices& choices = viewer.teaching().choices;
  return choices.lecture && choices.page == LecturePage::kShots;
}

namespace {

/// Without regard to whether the panel is wanted.
BesideScene besideSceneWithPanel(const Viewer& viewer, int width) {
  const double scale = viewer.scale();
  const int panel = width >= leastWindowWithPanel(scale) ? panelWidth(scale) : 0;
  if (!viewer.teaching().choices.lecture) return {panel, 0, 0};
  const double lines = std::min<double>(kLeastWidth * scale, width - 1);
  const int lecture =
      static_cast<int>(std::lround(std::min(kWidth * scale, std::max(lines, kMostOfWindow * width))));
  return {width - panel - lecture >= kLeastScene * scale ? panel : 0, lecture, 0};
}

}  // namespace

BesideScene besideScene(const Viewer& viewer, int width) {
  const ViewerState& ui = viewer.ui();
  if (ui.clean) return {};
  BesideScene out = besideSceneWithPanel(viewer, width);
  if (ui.panel && ui.panel_over && out.panel == 0) return {0, 0, std::min(panelWidth(viewer.scale()), width)};
  if (!ui.panel) out.panel = 0;
  return out;
}

bool panelHasRoom(const Viewer& viewer) {
  const auto width = static_cast<int>(ImGui::GetIO().DisplaySize.x);
  return width <= 0 || besideSceneWithPanel(viewer, width).panel > 0;  // before the first frame: it may
}

void buildLecture(Viewer& viewer, int left, int width) {
  if (width == 0) return;
  ImGui::SetNextWindowPos({static_cast<float>(left), 0});
  ImGui::SetNextWindowSize({static_cast<float>(width), ImGui::GetIO().DisplaySize.y});
  ImGui::Begin("lecture", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing);
  tabs(viewer);
  ImGui::Separator();
  ImGui::BeginChild("page");
  page(viewer, viewer.teaching().choices.page);
  ImGui::EndChild();
  ImGui::End();
}

void buildLectureMarks(Viewer& viewer, int scene_width) {
  Teaching& teaching = viewer.teaching();
  teaching.beginMarks();
  if (teaching.marks().empty()) return;
  forEachMarkedPicture(viewer, scene_width, [&](ImDrawList& list, const MarkedPicture& picture) {
    for (const auto& mark : teaching.marks()) {
      const auto colour = [&](int alpha) {
        return mark->source ? IM_COL32(255, 176, 64, alpha) : IM_COL32(96, 190, 255, alpha);
      };
      markFilled(list, picture, mark->lit, colour(120));
      markOutline(list, picture, mark->outline, colour(255));
    }
  });
}

}  // namespace unshot
