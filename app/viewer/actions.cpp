#include "viewer/actions.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "base/error.h"
#include "base/parse.h"
#include "formfactor/methods.h"
#include "mesh/build.h"
#include "render/display_modes.h"
#include "scene/sky.h"
#include "solver/modes.h"
#include "viewer/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

// What they do.

void runCamera(Viewer& viewer, const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  viewer.setCamera({n[0], n[1], n[2]}, {n[3], n[4], n[5]},
                   n.size() == 7 ? std::optional<double>(n[6]) : std::nullopt);
}

void runElements(Viewer& viewer, const std::string& text) {
  const std::uint64_t elements = whole(text);
  viewer.ui().options.elements = elements > 0 ? std::optional(elements) : std::nullopt;
  viewer.ui().options.element_size.reset();
  viewer.restart();
}

void nextDisplay(Viewer& viewer, const std::string&) {
  std::string& shown = viewer.ui().settings.view.display;
  const auto modes = displayModes();
  std::size_t at = 0;
  while (at < modes.size() && modes[at].info.key != shown) ++at;
  shown = modes[(at + 1) % modes.size()].info.key;
  viewer.notice("display: " + std::string(displayMode(shown).info.title));
}

void runReflectance(Viewer& viewer, const std::string& text) {
  const auto wanted = materialAndColour(text);
  viewer.edit([&](MaterialEdits& edits) {
    edits.setReflectance(edits.find(wanted.first), wanted.second, viewer.gesture());
  });
}

void runEmission(Viewer& viewer, const std::string& text) {
  const auto wanted = materialAndColour(text);
  viewer.edit([&](MaterialEdits& edits) {
    edits.setEmission(edits.find(wanted.first), wanted.second, viewer.gesture());
  });
}

void runLight(Viewer& viewer, const std::string& text) {
  const auto wanted = materialAndSwitch(text);
  viewer.edit([&](MaterialEdits& edits) { edits.setLight(edits.find(wanted.first), wanted.second); });
}

constexpr Shortcut kNone{};

const std::
    array
        kActions =
            {
                Action{"open", "PATH", "Open a scene and solve it (or drop a file on the window)", kNone,
                       [](Viewer& v, const std::string& a) { v.open(a); }},
                Action{"pause",
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
                Action{"step",
                       "[N]",
                       "Shoot once (or N times), then pause",
                       {GLFW_KEY_N, false, "N"},
                       [](Viewer& v, const std::string& a) { v.step(a.empty() ? 1 : whole(a)); },
                       [](const std::string& a) {
                         return a.empty() ? std::string() : checkWhole<1, 1'000'000'000>(a);
                       }},
                Action{"restart",
                       "",
                       "Solve the scene again from the start",
                       {GLFW_KEY_R, true, "Ctrl+R"},
                       [](Viewer& v, const std::string&) { v.restart(); }},
                Action{"save-solve",
                       "[PATH]",
                       "Save the solve, to go on later (unshot view or solve --resume)",
                       {GLFW_KEY_S, true, "Ctrl+S"},
                       [](Viewer& v, const std::string& a) { v.saveSolve(a); }},
                Action{"mode", "KEY", "Iterate in another way; what was shot and received stays", kNone,
                       [](Viewer& v, const std::string& a) { v.setMode(a); },
                       [](const std::string& a) { return checkKey(iterationModes(), true, a); }},
                Action{"race", "KEY|off",
                       "Both from nothing: this iteration mode against another, side by side", kNone,
                       [](Viewer& v, const std::string& a) {
                         v.race(a == "off" ? std::nullopt : std::optional(a));
                       },
                       [](const std::string& a) {
                         if (a == "off") return std::string();
                         const std::string wrong = checkKey(iterationModes(), true, a);
                         return wrong.empty() ? wrong : wrong + ", off";
                       }},
                Action{"form-factors", "KEY", "Solve again with another form-factor method", kNone,
                       [](Viewer& v, const std::string& a) {
                         v.ui().options.form_factors = a;
                         v.restart();
                       },
                       [](const std::string& a) { return checkKey(formFactorMethods(), true, a); }},
                Action{"elements", "N", "Solve again on a mesh of about N elements (0: chosen)", kNone,
                       runElements, checkWhole<0, kMostElements>},
                Action{"do", "KEY [on|off]", "Solve again with this done that the plan would leave out, or without",
                       kNone,
                       [](Viewer& v, const std::string& a) {
                         setDo(v.ui().options.do_anyway, a);
                         v.restart();
                       },
                       checkDo},
                Action{"do-all", "[on|off]", "Solve again with all of that done, or with none of it", kNone,
                       [](Viewer& v, const std::string& a) {
                         DoAnyway& done = v.ui().options.do_anyway;
                         bool all = doesAll(done);
                         setSwitch(all, a);
                         done = all ? doAll() : DoAnyway();
                         v.restart();
                       },
                       checkSwitch},
                Action{"reflectance", "MATERIAL r,g,b",
                       "Give a material another reflectance; the solve goes on with it", kNone,
                       runReflectance,
                       checkReflectance, true},
                Action{"emission", "MATERIAL r,g,b",
                       "Give a material another emission [W/m^2]; the solve goes on with it", kNone,
                       runEmission,
                       checkEmission, true},
                Action{"light", "MATERIAL on|off", "Make a material a light, or none",
                       kNone, runLight,
                       checkLight, true},
                Action{"undo", "", "Take the last change of a material back",
                       {GLFW_KEY_Z, true, "Ctrl+Z"},
                       [](Viewer& v, const std::string&) { v.edit([](MaterialEdits& e) { e.undo(); }); }},
                Action{"redo", "", "Change it again",
                       {GLFW_KEY_Y, true, "Ctrl+Y"},
                       [](Viewer& v, const std::string&) { v.edit([](MaterialEdits& e) { e.redo(); }); }},
                Action{"reset-materials", "", "All materials as the scene was opened", kNone,
                       [](Viewer& v, const std::string&) { v.edit([](MaterialEdits& e) { e.reset(); }); }},
                Action{"save-materials", "[PATH]", "Write reflectance and emission of all materials as MTL",
                       kNone, [](Viewer& v, const std::string& a) { v.saveMaterials(a); }, nullptr, true},
                Action{"materials", "[on|off]", "Show or hide the materials, in the panel", kNone,
                       [](Viewer& v, const std::string& a) { setSwitch(v.ui().materials, a); }, checkSwitch},
                Action{"sky", "r,g,b",
                       "Solve again under a uniform sky of this radiosity [W/m^2] (auto: 1,1,1 where no face "
                       "emits)",
                       kNone,
                       [](Viewer& v, const std::string& a) {
                         v.ui().options.sky = parseSky(a);
                         v.restart();
                       },
                       [](const std::string& a) {
                         return a == "auto" || parseSky(a)
                                    ? ""
                                    : "'" + a + "' is no sky r,g,b of numbers from 0 on, nor auto";
                       }},
                Action{"hemicube", "N", "Solve again with hemicubes of N pixels (even; 0: chosen)", kNone,
                       [](Viewer& v, const std::string& a) {
                         v.ui().options.hemicube_resolution = static_cast<std::uint32_t>(whole(a));
                         v.restart();
                       },
                       [](const std::string& a) {
                         if (a == "0") return std::string();
                         const std::string wrong = checkWhole<16, 4096>(a);
                         return wrong.empty() && whole(a) % 2 != 0 ? "'" + a + "' is not even" : wrong;
                       }},
                Action{"error", "X", "Stop when the bound of the solver's error is below this", kNone,
                       [](Viewer& v, const std::string& a) { v.setError(*parseNumber(a)); }, checkFraction},
                Action{"display", "KEY", "What is shown: a display mode", kNone,
                       [](Viewer& v, const std::string& a) { v.ui().settings.view.display = a; },
                       [](const std::string& a) { return checkKey(displayModes(), false, a); }},
                Action{"next-display", "", "The next display mode", {GLFW_KEY_M, false, "M"}, nextDisplay},
                Action{"unit", "watts|LM/W", "The unit of false colours: W/m2, or lux with so many lumens per watt",
                       kNone,
                       [](Viewer& v, const std::string& a) {
                         v.ui().settings.view.false_colour.lumens_per_watt = a == "watts" ? 0 : *parseNumber(a);
                       },
                       checkUnit},
                Action{"isolines", "[on|off]", "False colours with isolines, or without", kNone,
                       [](Viewer& v, const std::string& a) {
                         setSwitch(v.ui().settings.view.false_colour.isolines, a);
                       },
                       checkSwitch},
                Action{"logarithmic", "[on|off]", "False colours over three decades, or from 0 on", kNone,
                       [](Viewer& v, const std::string& a) {
                         setSwitch(v.ui().settings.view.false_colour.logarithmic, a);
                       },
                       checkSwitch},
                Action{"radiosity",
                       "[on|off]",
                       "With or without radiosity: all light, or only what comes straight from lamps",
                       {GLFW_KEY_B, false, "B"},
                       [](Viewer& v, const std::string& a) {
                         setSwitch(v.ui().settings.view.light.indirect, a);
                       },
                       checkSwitch},
                Action{"bounces", "N|all", "Only the light of the first N bounces, computing what they need",
                       kNone,
                       [](Viewer& v, const std::string& a) {
                         v.setBounces(a == "all" ? std::nullopt
                                                 : std::optional(static_cast<std::uint32_t>(whole(a))));
                       },
                       checkBounces},
                Action{"complete-bounces",
                       "", "Compute at rest the form factors that light by bounces still lacks",
                       kNone, [](Viewer& v, const std::string&) { v.completeBounces(); }},
                Action{"remember",
                       "",
                       "Remember this light, for the difference from it (display difference)",
                       {GLFW_KEY_K, false, "K"},
                       [](Viewer& v, const std::string&) { v.remember(); },
                       nullptr,
                       true},
                Action{"reference", "PATH", "Difference from a solution that unshot solve --ply wrote",
                       kNone, [](Viewer& v, const std::string& a) { v.loadReference(a); }, nullptr, true},
                Action{"forget", "", "Difference from direct light again, not from what was remembered",
                       kNone, [](Viewer& v, const std::string&) { v.forget(); }},
                Action{
                    "ambient",
                    "[on|off]",
                    "Add the estimate of light still unshot to the picture",
                    {GLFW_KEY_G, false, "G"},
                    [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.view.ambient, a); },
                    checkSwitch},
                Action{
                    "exposure", "EV", "Stops brighter than the automatic exposure", kNone,
                    [](Viewer& v, const std::string& a) {
                      v.ui().settings.view.exposure_ev = *parseNumber(a);
                    },
                    checkNumber},
                Action{"brighter",
                       "",
                       "Half a stop brighter",
                       {GLFW_KEY_EQUAL, false, "+"},
                       [](Viewer& v, const std::string&) { v.ui().settings.view.exposure_ev += 0.5; }},
                Action{"darker",
                       "",
                       "Half a stop darker",
                       {GLFW_KEY_MINUS, false, "-"},
                       [](Viewer& v, const std::string&) { v.ui().settings.view.exposure_ev -= 0.5; }},
                Action{"lock-exposure",
                       "[on|off]",
                       "Keep the present exposure, or follow the light",
                       {GLFW_KEY_L, false, "L"},
                       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.exposure_locked, a); },
                       checkSwitch},
                Action{"frame",
                       "",
                       "Back to the camera chosen for the scene",
                       {GLFW_KEY_F, false, "F"},
                       [](Viewer& v, const std::string&) { v.frameScene(); },
                       nullptr,
                       true},
                Action{"pick", "X,Y",
                       "Pick what is there in the picture, from 0,0 (left, top) to 1,1 (or click it)", kNone,
                       [](Viewer& v, const std::string& a) {
                         const std::vector<double> at = numbersOf(a);
                         v.pick({at[0], at[1]});
                       },
                       checkPlace, true},
                Action{"pin-probe",
                       "",
                       "Keep the picked point as a probe",
                       {GLFW_KEY_P, false, "P"},
                       [](Viewer& v, const std::string&) { v.pinProbe(); }},
                Action{"save-probes", "[PATH]",
                       "Write the probes and their B as CSV (as unshot solve --probe-out)", kNone,
                       [](Viewer& v, const std::string& a) { v.saveProbes(a); }, nullptr, true},
                Action{"unpin-probe", "N", "Give up the Nth probe", kNone,
                       [](Viewer& v, const std::string& a) { v.unpinProbe(whole(a) - 1); },
                       checkWhole<1, 1'000'000>},
                Action{"clear-probes", "", "Give up all probes", kNone,
                       [](Viewer& v, const std::string&) { v.clearProbes(); }},
                Action{"copy-values",
                       "",
                       "Copy all values of the picked point",
                       {GLFW_KEY_C, true, "Ctrl+C"},
                       [](Viewer& v, const std::string&) { v.copyValues(); },
                       nullptr,
                       true},
                Action{"focus-picked",
                       "",
                       "Look at the picked point and orbit around it",
                       {GLFW_KEY_C, false, "C"},
                       [](Viewer& v, const std::string&) { v.focusPicked(); },
                       nullptr,
                       true},
                Action{"unpick", "", "Pick nothing", kNone,
                       [](Viewer& v, const std::string&) { v.unpick(); }},
                Action{"camera", "EX,EY,EZ,AX,AY,AZ[,FOV]",
                       "Stand at E and look at A, in the file's coordinates", kNone, runCamera, checkCamera,
                       true},
                Action{"panel",
                       "[on|off]",
                       "Show or hide the panel",
                       {GLFW_KEY_TAB, false, "Tab"},
                       [](Viewer& v, const std::string& a) { setSwitch(v.ui().panel, a); },
                       checkSwitch},
                Action{"notes", "[on|off]", "Show or hide what is doubtful about the scene, in the panel",
                       kNone, [](Viewer& v, const std::string& a) { setSwitch(v.ui().notes, a); },
                       checkSwitch},
                Action{"left-out", "[on|off]", "Show or hide what the solve leaves out, in the panel", kNone,
                       [](Viewer& v, const std::string& a) { setSwitch(v.ui().left_out, a); }, checkSwitch},
                Action{"help",
                       "[on|off]",
                       "Show or hide this help",
                       {GLFW_KEY_H, false, "H"},
                       [](Viewer& v, const std::string& a) { setSwitch(v.ui().help, a); },
                       checkSwitch},
                Action{
                    "dismiss",
                    "",
                    "Close the message or the help, or pick nothing",
                    {GLFW_KEY_ESCAPE, false, "Esc"},
                    [](Viewer& v, const std::string&) { v.dismiss(); }},
                Action{"plot", "seconds|shots|rows", "What the curve runs against",
                       kNone, [](Viewer& v, const std::string& a) { v.ui().plot_axis = *plotAxis(a); },
                       [](const std::string& a) {
                         return plotAxis(a) ? std::string()
                                            : "'" + a + "' is neither seconds, shots nor rows";
                       }},
                Action{"again", "", "Shoot again from nothing, with the form factors at hand",
                       kNone, [](Viewer& v, const std::string&) { v.shootAgain(); }},
                Action{
                    "size", "WxH", "Make the window this large [px]", kNone,
                    [](Viewer& v, const std::string& a) {
                      const auto size = sizeOf(a);
                      v.resizeWindow(size->first, size->second);
                    },
                    checkSize},
                Action{"scale", "S", "Size of panels and text, 1 is normal", kNone,
                       [](Viewer& v, const std::string& a) { v.setScale(*parseNumber(a)); }, checkScale},
                Action{"screenshot",
                       "[PATH]",
                       "Write what the window shows as PNG",
                       {GLFW_KEY_F12, false, "F12"},
                       [](Viewer& v, const std::string& a) { v.screenshot(a, true); },
                       nullptr,
                       true},
                Action{"screenshot-scene",
                       "[PATH]",
                       "The same without panels",
                       {GLFW_KEY_F12, true, "Ctrl+F12"},
                       [](Viewer& v, const std::string& a) { v.screenshot(a, false); },
                       nullptr,
                       true},
                Action{"quit",
                       "",
                       "Close the window",
                       {GLFW_KEY_Q, true, "Ctrl+Q"},
                       [](Viewer& v, const std::string&) { v.close(); }},
};

}  // namespace

std::span<const Action> actions() { return kActions; }

const Action& findAction(std::string_view key) {
  for (const Action& action : kActions) {
    if (action.key == key) return action;
  }
  std::string keys = "wait";
  for (const Action& action : kActions) keys += ", " + std::string(action.key);
  throw Error(ErrorKind::kUsage, "there is no action '" + std::string(key) + "'", {}, "one of: " + keys);
}

std::string checkArgument(const Action& action, const std::string& argument) {
  if (action.argument.empty()) {
    return argument.empty() ? "" : "'" + std::string(action.key) + "' takes no argument";
  }
  if (argument.empty() && action.needsArgument())
    return "'" + std::string(action.key) + "' needs " + std::string(action.argument);
  return action.check ? action.check(argument) : "";
}

const Action* actionOfKey(int key, bool ctrl) {
  if (key == GLFW_KEY_KP_ADD) key = GLFW_KEY_EQUAL;
  if (key == GLFW_KEY_KP_SUBTRACT) key = GLFW_KEY_MINUS;
  for (const Action& action : kActions) {
    if (action.shortcut.key != 0 && action.shortcut.key == key && action.shortcut.ctrl == ctrl)
      return &action;
  }
  return nullptr;
}

}  // namespace unshot
