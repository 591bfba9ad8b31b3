// Actions: panels, window and pictures of it.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "base/parse.h"
#include "viewer/actions/action_arguments.h"
#include "viewer/panels/lecture_panel.h"
#include "viewer/panels/sections.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

std::string checkSection(const std::string& text) {
  const auto [key, on] = keyAndSwitch(text);
  const std::string wrong = checkKey(panelSections(), false, key);
  return wrong.empty() ? checkSwitch(on) : wrong;
}

void runPanel(Viewer& viewer, const std::string& text) {
  ViewerState& ui = viewer.ui();
  const bool room = panelHasRoom(viewer);
  bool shown = ui.panel && (room || ui.panel_over);
  setSwitch(shown, text);
  ui.panel_over = shown && !room;
  // Lifted off the scene again it only has no room: the line below stays.
  ui.panel = shown || (!room && text.empty());
}

void runSection(Viewer& viewer, const std::string& text) {
  const auto [key, on] = keyAndSwitch(text);
  openSection(viewer.ui(), key, on.empty() ? std::nullopt : std::optional(on == "on"));
}

}  // namespace

std::span<const Action> windowActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"panel",
       "[on|off]",
       "Show or hide the panel; over the scene, where there is no room beside it",
       {GLFW_KEY_TAB, false, "Tab"},
       runPanel,
       checkSwitch},
      {"clean",
       "[on|off|legend]",
       "Show the scene alone (or with the legend of its colours), or with all that was over it and beside it",
       {GLFW_KEY_X, false, "X"},
       [](Viewer& v, const std::string& a) {
         v.ui().clean_legend = a == "legend";
         setSwitch(v.ui().clean, a == "legend" ? "on" : a);
       },
       [](const std::string& a) {
         return a == "legend" || checkSwitch(a).empty() ? std::string()
                                                        : "'" + a + "' is neither on, off nor legend";
       }},
      {"full-screen",
       "[on|off]",
       "Fill the screen with the window, or give it back its place",
       {GLFW_KEY_F11, false, "F11"},
       [](Viewer& v, const std::string& a) {
         v.fillScreen(a.empty() ? std::nullopt : std::optional(a == "on"));
       },
       checkSwitch},
      {"status",
       "[on|off]",
       "Show or hide the line at the bottom of the scene, which the panel takes with it",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().status, a); },
       checkSwitch},
      {"section",
       "KEY [on|off]",
       "Open or close a section of the panel, and scroll to it: solve, display, messages ...",
       {},
       runSection,
       checkSection,
       false,
       rowsOf<PanelSection, panelSections>},
      {"notes",
       "[on|off]",
       "Show or hide what is doubtful about the scene, in the panel",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().notes, a); },
       checkSwitch},
      {"left-out",
       "[on|off]",
       "Show or hide what the solve leaves out, in the panel",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().left_out, a); },
       checkSwitch},
      {"materials",
       "[on|off]",
       "Show or hide the materials, in the panel",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().materials, a); },
       checkSwitch},
      {"plot",
       "seconds|shots|rows",
       "What the curve runs against",
       {},
       [](Viewer& v, const std::string& a) { v.ui().plot_axis = *plotAxis(a); },
       [](const std::string& a) {
         return plotAxis(a) ? std::string() : "'" + a + "' is neither seconds, shots nor rows";
       }},
      {"help",
       "[on|off]",
       "Show or hide this help",
       {GLFW_KEY_H, false, "H"},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().help, a); },
       checkSwitch},
      {"actions",
       "[TEXT]",
       "Search all actions and perform one",
       {GLFW_KEY_P, true, "Ctrl+P"},
       [](Viewer& v, const std::string& a) { v.searchActions(a); }},
      {"dismiss",
       "",
       "Close what lies over the scene, give up loading, or pick nothing",
       {GLFW_KEY_ESCAPE, false, "Esc"},
       [](Viewer& v, const std::string&) { v.dismiss(); }},
      {"dismiss-notices",
       "",
       "Close the lines over the scene that tell of files written",
       {},
       [](Viewer& v, const std::string&) { v.dismissNotices(); }},
      {"size",
       "WxH",
       "Make the window this large [px]",
       {},
       [](Viewer& v, const std::string& a) {
         const auto size = sizeOf(a);
         v.resizeWindow(size->first, size->second);
       },
       checkSize},
      {"scale",
       "S",
       "Size of panels and text, 1 is normal",
       {},
       [](Viewer& v, const std::string& a) { v.setScale(*parseNumber(a)); },
       checkScale},
      {"screenshot",
       "[PATH]",
       "Write what the window shows as PNG",
       {GLFW_KEY_F12, false, "F12"},
       [](Viewer& v, const std::string& a) { v.screenshot(a, true); },
       nullptr,
       true},
      {"screenshot-scene",
       "[PATH]",
       "The same without panels",
       {GLFW_KEY_F12, true, "Ctrl+F12"},
       [](Viewer& v, const std::string& a) { v.screenshot(a, false); },
       nullptr,
       true},
      {"quit",
       "",
       "Close the window",
       {GLFW_KEY_Q, true, "Ctrl+Q"},
       [](Viewer& v, const std::string&) { v.close(); }},
  });
  return kActions;
}

}  // namespace unshot
