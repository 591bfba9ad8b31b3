// Actions: the camera.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

void runCamera(Viewer& viewer, const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  viewer.setCamera({n[0], n[1], n[2]}, {n[3], n[4], n[5]},
                   n.size() == 7 ? std::optional<double>(n[6]) : std::nullopt);
}

void runPreset(Viewer& viewer, const std::string& key) {
  const Camera& camera = findChoice(cameraPresets(), key, "camera").camera;
  viewer.setCamera(camera.eye, camera.at, camera.fov_deg);  // throws without a scene
  viewer.navigator().setOrthographic(camera.orthographic);
}

void runProjection(Viewer& viewer, const std::string& text) {
  bool orthographic = viewer.camera().orthographic;
  orthographic = text.empty() ? !orthographic : text == "orthographic";
  viewer.navigator().setOrthographic(orthographic);
  viewer.passingNotice(orthographic ? "orthographic" : "perspective");
}

std::string checkProjection(const std::string& text) {
  return text.empty() || text == "perspective" || text == "orthographic"
             ? ""
             : "'" + text + "' is neither perspective nor orthographic";
}

}  // namespace

std::span<const Action> cameraActions() {
  static constexpr auto kActions = std::to_array<Action>({
      {"frame",
       "",
       "Back to the camera chosen for the scene",
       {GLFW_KEY_F, false, "F"},
       [](Viewer& v, const std::string&) { v.frameScene(); },
       nullptr,
       true},
      {"view",
       "front|back|left|right|top|bottom",
       "All of the scene along an axis",
       {GLFW_KEY_1, true, "Ctrl+1 to 6", 6},
       [](Viewer& v, const std::string& a) { v.viewAlong(findChoice(axisViews(), a, "view")); },
       [](const std::string& a) { return checkKey(axisViews(), false, a); },
       true},
      {"projection",
       "[perspective|orthographic]",
       "Things far away look smaller, or as large as near ones",
       {GLFW_KEY_O, false, "O"},
       runProjection,
       checkProjection},
      {"fov",
       "DEGREES",
       "Vertical angle of view, from 1 to 170",
       {},
       [](Viewer& v, const std::string& a) { v.navigator().setAngle(*parseNumber(a)); },
       checkAngle},
      {"speed",
       "X",
       "Speed of flight: 1 crosses the scene in five seconds",
       {},
       [](Viewer& v, const std::string& a) { v.navigator().setSpeedFactor(*parseNumber(a)); },
       checkSpeed},
      {"camera",
       "EX,EY,EZ,AX,AY,AZ[,FOV]",
       "Stand at E and look at A, in the file's coordinates",
       {},
       runCamera,
       checkCamera,
       true},
      {"camera-preset",
       "NAME",
       "A camera that was published with a scene: cornell",
       {},
       runPreset,
       [](const std::string& a) { return checkKey(cameraPresets(), false, a); },
       true},
      {"copy-camera",
       "[script|options]",
       "Copy the camera as lines of a script, or as options of unshot solve",
       {},
       [](Viewer& v, const std::string& a) { v.copyCamera(a == "options"); },
       [](const std::string& a) {
         return a.empty() || a == "script" || a == "options" ? std::string()
                                                             : "'" + a + "' is neither script nor options";
       },
       true},
  });
  return kActions;
}

}  // namespace unshot
