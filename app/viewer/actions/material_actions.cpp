// Actions: materials, changed while the solve goes on.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

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

}  // namespace

std::span<const Action> materialActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"material",
       "MATERIAL",
       "Choose the material that the panel shows under \"Materials\"",
       {},
       [](Viewer& v, const std::string& a) { v.ui().material = v.edits().find(a); },
       nullptr,
       true},
      {"reflectance",
       "MATERIAL r,g,b",
       "Give a material another reflectance; the solve goes on with it",
       {},
       runReflectance,
       checkReflectance,
       true},
      {"emission",
       "MATERIAL r,g,b",
       "Give a material another emission [W/m\u00b2]; the solve goes on with it",
       {},
       runEmission,
       checkEmission,
       true},
      {"light", "MATERIAL on|off", "Make a material a light, or none", {}, runLight, checkLight, true},
      {"undo",
       "",
       "Take the last change of a material back",
       {GLFW_KEY_Z, true, "Ctrl+Z"},
       [](Viewer& v, const std::string&) { v.edit([](MaterialEdits& e) { e.undo(); }); }},
      {"redo",
       "",
       "Change it again",
       {GLFW_KEY_Y, true, "Ctrl+Y"},
       [](Viewer& v, const std::string&) { v.edit([](MaterialEdits& e) { e.redo(); }); }},
      {"reset-materials",
       "",
       "All materials as the scene was opened",
       {},
       [](Viewer& v, const std::string&) { v.edit([](MaterialEdits& e) { e.reset(); }); }},
      {"save-materials",
       "[PATH]",
       "Write reflectance and emission of all materials as MTL",
       {},
       [](Viewer& v, const std::string& a) { v.saveMaterials(a); },
       nullptr,
       true},
  });
  return kActions;
}

}  // namespace unshot
