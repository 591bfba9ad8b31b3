// Actions: the hemicube and the lecture on the screen.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/actions/action_arguments.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/teaching.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr std::array<std::string_view, 3> kChannelNames = {"red", "green", "blue"};

std::string checkChannel(const std::string& text) {
  for (const std::string_view channel : kChannelNames) {
    if (text == channel) return {};
  }
  return "'" + text + "' is neither red, green nor blue";
}

/// Row and column, from 1 on.
std::string checkMatrixCell(const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  const auto counts = [](double x) { return x >= 1 && x <= 1e6 && x == std::floor(x); };
  const bool fits = text == "off" || (n.size() == 2 && std::all_of(n.begin(), n.end(), counts));
  return fits ? "" : "'" + text + "' is no cell I,J of whole numbers from 1 on, nor off";
}

void runMatrixCell(Viewer& viewer, const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  auto& cell = viewer.teaching().choices.cell;
  if (n.empty()) return cell.reset();
  cell = {static_cast<std::size_t>(n[0]) - 1, static_cast<std::size_t>(n[1]) - 1};
}

std::string checkFactor(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && *number >= 0.5 && *number <= 10 ? "" : "'" + text + "' is no number from 0.5 to 10";
}

std::string checkReflectanceOfAll(const std::string& text) {
  const std::optional<double> number = parseNumber(text);
  return number && *number >= 0.5 && *number <= 2 ? "" : "'" + text + "' is no number from 0.5 to 2";
}

/// What lies beside the scene is hidden by a panel over it, which goes where it is asked for.
void showBeside(Viewer& viewer, bool& shown, const std::string& text) {
  ViewerState& ui = viewer.ui();
  const bool covered = ui.panel && ui.panel_over && !panelHasRoom(viewer);
  if (covered && text.empty()) {
    shown = true;
  } else {
    setSwitch(shown, text);
  }
  if (covered && shown) ui.panel = false;
}

}  // namespace

std::span<const Action> lectureActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"hemicube-view",
       "[on|off]",
       "Show or hide what the picked patch, or the one that shoots, sees through its hemicube",
       {GLFW_KEY_U, false, "U"},
       [](Viewer& v, const std::string& a) {
         showBeside(v, v.teaching().choices.hemicube, a);
         if (lectureShowsHemicube(v)) v.passingNotice("the lecture's page Shots shows the hemicube");
       },
       checkSwitch},
      {"hemicube-picture",
       "KEY",
       "What the hemicube's pixels show: light, materials, patches, delta, shares",
       {},
       [](Viewer& v, const std::string& a) {
         v.teaching().choices.picture = findChoice(hemicubePictures(), a, "picture of a hemicube").colours;
       },
       [](const std::string& a) { return checkKey(hemicubePictures(), false, a); },
       false,
       rowsOf<HemicubePictureRow, hemicubePictures>},
      {"hemicube-pixel",
       "X,Y|off",
       "Mark what is seen there in the hemicube, from 0,0 (left, top) to 1,1, as the mouse does",
       {},
       [](Viewer& v, const std::string& a) {
         const std::vector<double> at = numbersOf(a);
         v.teaching().choices.pixel = at.empty() ? std::nullopt : std::optional(glm::dvec2(at[0], at[1]));
       },
       [](const std::string& a) { return a == "off" ? std::string() : checkPlace(a); }},
      {"lecture",
       "[on|off]",
       "Show or hide the lecture: matrix, equation, single shots, effects",
       {GLFW_KEY_T, false, "T"},
       [](Viewer& v, const std::string& a) { showBeside(v, v.teaching().choices.lecture, a); },
       checkSwitch},
      {"lecture-page",
       "KEY",
       "Open the lecture at this page: matrix, equation, shots, effects",
       {},
       [](Viewer& v, const std::string& a) {
         v.teaching().choices.page = findChoice(lecturePages(), a, "page of the lecture").page;
         showBeside(v, v.teaching().choices.lecture, "on");
       },
       [](const std::string& a) { return checkKey(lecturePages(), false, a); },
       false,
       rowsOf<LecturePageRow, lecturePages>},
      {"matrix-power",
       "K",
       "Which power of M, or partial sum up to it, the lecture shows",
       {},
       [](Viewer& v, const std::string& a) { v.teaching().choices.power = whole(a); },
       checkWhole<0, MatrixSeries::kMost>},
      {"matrix-sums",
       "[on|off]",
       "The partial sum I + M + ... + M^k in the lecture, or the power M^k",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.teaching().choices.sums, a); },
       checkSwitch},
      {"matrix-cell",
       "I,J|off",
       "Mark the cell in row I and column J of the lecture's matrix, from 1 on, as the mouse does",
       {},
       runMatrixCell,
       checkMatrixCell},
      {"matrix-channel",
       "red|green|blue",
       "Whose reflectance is in the lecture's matrix",
       {},
       [](Viewer& v, const std::string& a) {
         v.teaching().choices.channel = a == kChannelNames[0] ? 0 : a == kChannelNames[1] ? 1 : 2;
       },
       checkChannel},
      {"allow-divergence",
       "[on|off]",
       "Let the lecture's matrix have other reflectances, also 1 and above",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.teaching().choices.allow_divergence, a); },
       checkSwitch},
      {"matrix-factor",
       "F",
       "Then each group's own reflectance times F, 0.5 to 10",
       {},
       [](Viewer& v, const std::string& a) {
         v.teaching().choices.factor = *parseNumber(a);
         v.teaching().choices.alike = false;
       },
       checkFactor},
      {"matrix-reflectance",
       "R",
       "Or one reflectance for all groups, 0.5 to 2",
       {},
       [](Viewer& v, const std::string& a) {
         v.teaching().choices.reflectance = *parseNumber(a);
         v.teaching().choices.alike = true;
       },
       checkReflectanceOfAll},
  });
  return kActions;
}

}  // namespace unshot
