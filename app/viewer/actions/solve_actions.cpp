// Actions: the scene and its solve.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "base/parse.h"
#include "formfactor/methods.h"
#include "mesh/build.h"
#include "scene/sky.h"
#include "solver/modes.h"
#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

void runElements(Viewer& viewer, const std::string& text) {
  const std::uint64_t elements = whole(text);
  viewer.ui().options.elements = elements > 0 ? std::optional(elements) : std::nullopt;
  viewer.ui().options.element_size.reset();
  viewer.restart();
}

}  // namespace

std::span<const Action> solveActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"open",
       "PATH",
       "Open a scene and solve it, or go on from a saved solve of it (or drop the file on the window)",
       {},
       [](Viewer& v, const std::string& a) { v.open(a); }},
      {"give-up",
       "[N]",
       "Give up the first (or the Nth) of what takes its time, as its button does: loading, a save ...",
       {},
       [](Viewer& v, const std::string& a) { v.giveUp(a.empty() ? 0 : whole(a) - 1); },
       [](const std::string& a) { return a.empty() ? std::string() : checkWhole<1, 100>(a); }},
      {"browse",
       "[FOLDER]",
       "Choose a file from a list, to open or to compare with",
       {GLFW_KEY_O, true, "Ctrl+O"},
       [](Viewer& v, const std::string& a) { v.browse(a); }},
      {"reload",
       "",
       "Read the scene's files again and solve it; the camera stays",
       {GLFW_KEY_F5, false, "F5"},
       [](Viewer& v, const std::string&) { v.reload(); }},
      {"keep-scene",
       "",
       "Go on with the scene as it was read, though its files have changed",
       {},
       [](Viewer& v, const std::string&) { v.keepScene(); }},
      {"watch",
       "[on|off]",
       "Say when the scene's files change on disk",
       {},
       [](Viewer& v, const std::string& a) {
         bool on = v.watchingScene();
         setSwitch(on, a);
         v.watchScene(on);
       },
       checkSwitch},
      {"pause",
       "[on|off]",
       "Pause the solve, or go on",
       {GLFW_KEY_SPACE, false, "Space"},
       [](Viewer& v, const std::string& a) {
         if (a.empty()) {
           v.pauseOrResume();
         } else if (a == "on") {
           v.pause();
         } else {
           v.resume();
         }
       },
       checkSwitch},
      {"step",
       "[N]",
       "Shoot once (or N times), then pause",
       {GLFW_KEY_N, false, "N"},
       [](Viewer& v, const std::string& a) { v.step(a.empty() ? 1 : whole(a)); },
       [](const std::string& a) { return a.empty() ? std::string() : checkWhole<1, 1'000'000'000>(a); }},
      {"restart",
       "",
       "Solve the scene again from the start",
       {GLFW_KEY_R, true, "Ctrl+R"},
       [](Viewer& v, const std::string&) { v.restart(); }},
      {"again",
       "",
       "Shoot again from nothing, with the form factors at hand",
       {},
       [](Viewer& v, const std::string&) { v.shootAgain(); }},
      {"save-solve",
       "[PATH]",
       "Save the solve; opened later, it goes on",
       {GLFW_KEY_S, true, "Ctrl+S"},
       [](Viewer& v, const std::string& a) { v.saveSolve(a); }},
      {"mode",
       "KEY",
       "Iterate in another way; what was shot and received stays",
       {},
       [](Viewer& v, const std::string& a) { v.setMode(a); },
       [](const std::string& a) { return checkKey(iterationModes(), true, a); },
       false,
       rowsOf<IterationModeRow, iterationModes>},
      {"race",
       "KEY|off",
       "Both from nothing: this iteration mode against another, side by side",
       {},
       [](Viewer& v, const std::string& a) { v.race(a == "off" ? std::nullopt : std::optional(a)); },
       [](const std::string& a) {
         if (a == "off") return std::string();
         const std::string wrong = checkKey(iterationModes(), true, a);
         return wrong.empty() ? wrong : wrong + ", off";
       },
       false,
       rowsOf<IterationModeRow, iterationModes>},
      {"form-factors",
       "KEY",
       "Solve again with another form-factor method",
       {},
       [](Viewer& v, const std::string& a) {
         v.ui().options.form_factors = a;
         v.restart();
       },
       [](const std::string& a) { return checkKey(formFactorMethods(), true, a); },
       false,
       rowsOf<FormFactorMethodRow, formFactorMethods>},
      {"elements",
       "N",
       "Solve again on a mesh of about N elements (0: chosen)",
       {},
       runElements,
       checkWhole<0, kMostElements>},
      {"hemicube",
       "N",
       "Solve again with hemicubes of N pixels (even; 0: chosen)",
       {},
       [](Viewer& v, const std::string& a) {
         v.ui().options.hemicube_resolution = static_cast<std::uint32_t>(whole(a));
         v.restart();
       },
       [](const std::string& a) {
         if (a == "0") return std::string();
         const std::string wrong = checkWhole<16, 4096>(a);
         return wrong.empty() && whole(a) % 2 != 0 ? "'" + a + "' is not even" : wrong;
       }},
      {"error",
       "X",
       "Stop when the bound of the solver's error is below this",
       {},
       [](Viewer& v, const std::string& a) { v.setError(*parseNumber(a)); },
       checkFraction},
      {"sky",
       "r,g,b",
       "Solve again under a uniform sky of this radiosity [W/m\u00b2] (auto: 1,1,1 where no face "
       "emits)",
       {},
       [](Viewer& v, const std::string& a) {
         v.ui().options.sky = parseSky(a);
         v.restart();
       },
       [](const std::string& a) {
         return a == "auto" || parseSky(a) ? ""
                                           : "'" + a + "' is no sky r,g,b of numbers from 0 on, nor auto";
       }},
      {"emit",
       "both|front",
       "Solve again with lights that emit on both sides, or on their front alone",
       {},
       [](Viewer& v, const std::string& a) {
         v.ui().options.emit_front_only = a == "front";
         v.restart();
       },
       [](const std::string& a) {
         return a == "both" || a == "front" ? std::string() : "'" + a + "' is neither both nor front";
       }},
      {"keep",
       "MB",
       "Solve again with as much memory for form factors that are kept [MB]",
       {},
       [](Viewer& v, const std::string& a) {
         v.ui().options.kept_bytes = whole(a) * 1'000'000;
         v.restart();
       },
       checkWhole<0, 1'000'000>},
      {"do",
       "KEY [on|off]",
       "Solve again with this done that the plan would leave out, or without",
       {},
       [](Viewer& v, const std::string& a) {
         setDo(v.ui().options.do_anyway, a);
         v.restart();
       },
       checkDo},
      {"do-all",
       "[on|off]",
       "Solve again with all of that done, or with none of it",
       {},
       [](Viewer& v, const std::string& a) {
         DoAnyway& done = v.ui().options.do_anyway;
         bool all = doesAll(done);
         setSwitch(all, a);
         done = all ? doAll() : DoAnyway();
         v.restart();
       },
       checkSwitch},
  });
  return kActions;
}

}  // namespace unshot
