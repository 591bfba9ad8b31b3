// Actions: what of the light is shown, and how bright.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "base/parse.h"
#include "render/display_modes.h"
#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

void nextDisplay(Viewer& viewer, const std::string&) {
  std::string& shown = viewer.ui().settings.view.display;
  const auto modes = displayModes();
  std::size_t at = 0;
  while (at < modes.size() && modes[at].info.key != shown) ++at;
  shown = modes[(at + 1) % modes.size()].info.key;
  viewer.passingNotice("display: " + std::string(displayMode(shown).info.title));
}

std::optional<std::uint32_t> bouncesOf(const std::string& text) {
  return text == "all" ? std::nullopt : std::optional(static_cast<std::uint32_t>(whole(text)));
}

}  // namespace

std::span<const Action> displayActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"display",
       "KEY",
       "What is shown: a display mode",
       {},
       [](Viewer& v, const std::string& a) { v.ui().settings.view.display = a; },
       [](const std::string& a) { return checkKey(displayModes(), false, a); },
       false,
       rowsOf<DisplayMode, displayModes>},
      {"next-display", "", "The next display mode", {GLFW_KEY_M, false, "M"}, nextDisplay},
      {"tone",
       "KEY",
       "The curve from light to the display: a tone curve",
       {},
       [](Viewer& v, const std::string& a) { v.ui().settings.view.tone = a; },
       [](const std::string& a) { return checkKey(toneCurves(), false, a); },
       false,
       rowsOf<ToneCurve, toneCurves>},
      {"unit",
       "watts|LM/W",
       "The unit of false colours: W/m\u00b2, or lux with so many lumens per watt",
       {},
       [](Viewer& v, const std::string& a) {
         v.ui().settings.view.false_colour.lumens_per_watt = a == "watts" ? 0 : *parseNumber(a);
       },
       checkUnit},
      {"isolines",
       "[on|off]",
       "False colours with isolines, or without",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.view.false_colour.isolines, a); },
       checkSwitch},
      {"logarithmic",
       "[on|off]",
       "False colours over three decades, or from 0 on",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.view.false_colour.logarithmic, a); },
       checkSwitch},
      {"radiosity",
       "[on|off]",
       "With or without radiosity: all light, or only what comes straight from lamps",
       {GLFW_KEY_B, false, "B"},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.view.light.indirect, a); },
       checkSwitch},
      {"bounces",
       "N|all",
       "Only the light of up to N bounces, E + M E + ... + M^N E, computing what they need",
       {},
       [](Viewer& v, const std::string& a) { v.setBounces(bouncesOf(a)); },
       checkBounces},
      {"bounce-alone",
       "N|all",
       "Bounce N by itself, M^N E: the light of up to N bounces less that of up to N - 1",
       {},
       [](Viewer& v, const std::string& a) { v.setBounces(bouncesOf(a), true); },
       checkBounces},
      {"complete-bounces",
       "",
       "Compute at rest the form factors that light by bounces still lacks",
       {},
       [](Viewer& v, const std::string&) { v.completeBounces(); }},
      {"remember",
       "",
       "Remember this light, for the difference from it (display difference)",
       {GLFW_KEY_K, false, "K"},
       [](Viewer& v, const std::string&) { v.remember(); },
       nullptr,
       true},
      {"reference",
       "PATH",
       "Difference from a solution that unshot solve --ply wrote",
       {},
       [](Viewer& v, const std::string& a) { v.loadReference(a); },
       nullptr,
       true},
      {"reference-picture",
       "PATH",
       "Lay a picture (PNG, JPEG, HDR, PFM) of the present camera over the scene, to compare with",
       {},
       [](Viewer& v, const std::string& a) { v.loadReferencePicture(a); }},
      {"forget-picture",
       "",
       "Without the picture that is compared with",
       {},
       [](Viewer& v, const std::string&) { v.forgetReferencePicture(); }},
      {"wipe",
       "X",
       "Where the picture that is compared with begins: 0 at the left, 1 at the right",
       {},
       [](Viewer& v, const std::string& a) { v.ui().wipe = *parseNumber(a); },
       checkShare},
      {"picture-difference",
       "[on|off]",
       "The difference from the picture that is compared with, or both side by side",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().picture_difference, a); },
       checkSwitch},
      {"forget",
       "",
       "Difference from direct light again, not from what was remembered",
       {},
       [](Viewer& v, const std::string&) { v.forget(); }},
      {"ambient",
       "[on|off]",
       "Add the estimate of light still unshot to the picture",
       {GLFW_KEY_G, false, "G"},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.view.ambient, a); },
       checkSwitch},
      {"histogram",
       "[on|off]",
       "Show or hide how often which luminance is in view, in the panel",
       {},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.histogram, a); },
       checkSwitch},
      {"exposure",
       "EV",
       "Stops brighter than the automatic exposure",
       {},
       [](Viewer& v, const std::string& a) { v.ui().settings.view.exposure_ev = *parseNumber(a); },
       checkNumber},
      {"brighter",
       "",
       "Half a stop brighter",
       {GLFW_KEY_EQUAL, false, "+"},
       [](Viewer& v, const std::string&) { v.ui().settings.view.exposure_ev += 0.5; }},
      {"darker",
       "",
       "Half a stop darker",
       {GLFW_KEY_MINUS, false, "-"},
       [](Viewer& v, const std::string&) { v.ui().settings.view.exposure_ev -= 0.5; }},
      {"lock-exposure",
       "[on|off]",
       "Keep the present exposure, or follow the light",
       {GLFW_KEY_L, false, "L"},
       [](Viewer& v, const std::string& a) { setSwitch(v.ui().settings.exposure_locked, a); },
       checkSwitch},
  });
  return kActions;
}

}  // namespace unshot
