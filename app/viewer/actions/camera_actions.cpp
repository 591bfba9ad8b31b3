// Actions: the camera.
#include "viewer/actions/action_groups.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/actions/action_arguments.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr double kHalfTurn = 180;  // degrees, which a drag over the height of the picture turns by

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

/// So many numbers between commas, none of them larger than this.
template <std::size_t count, int most>
std::string checkNumbers(const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  const bool fits =
      n.size() == count && std::all_of(n.begin(), n.end(), [](double x) { return std::abs(x) <= most; });
  return fits ? ""
              : "'" + text + "' is not " + std::to_string(count) + " numbers from -" + std::to_string(most) +
                    " to " + std::to_string(most);
}

// The scene follows the mouse, and so goes the other way than the camera: right, but up as rows go down.
glm::dvec2 dragFor(const std::string& text) {
  const std::vector<double> n = numbersOf(text);
  return {-n[0], n[1]};
}

void runFly(Viewer& viewer, const std::string& text) {
  const std::optional<Camera> camera = viewer.cameraInFile();
  if (!camera) throw Error(ErrorKind::kUsage, "there is no scene to fly in yet", {}, "open a scene first");
  const std::vector<double> n = numbersOf(text);
  const ViewBasis basis = viewBasis(*camera);
  const glm::dvec3 by = n[0] * basis.right + n[1] * basis.up + n[2] * basis.forward;
  viewer.setCamera(camera->eye + by, camera->at + by, std::nullopt);
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
       true,
       rowsOf<AxisView, axisViews>},
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
      {"orbit",
       "X,Y",
       "Orbit around the point looked at, X degrees to the right and Y up",
       {},
       [](Viewer& v, const std::string& a) { v.navigator().orbit(dragFor(a), kHalfTurn); },
       checkNumbers<2, 360>,
       true},
      {"pan",
       "X,Y",
       "Move sideways: X times the picture's height to the right, Y times up, where it is looked at",
       {},
       [](Viewer& v, const std::string& a) { v.navigator().pan(dragFor(a), 1); },
       checkNumbers<2, 100>,
       true},
      {"zoom",
       "N",
       "Go to the point looked at by N notches of the wheel, or away from it",
       {},
       [](Viewer& v, const std::string& a) { v.navigator().zoom(*parseNumber(a)); },
       checkNumbers<1, 100>,
       true},
      {"fly",
       "X,Y,Z",
       "Move by X to the right, Y up and Z ahead [m]",
       {},
       runFly,
       checkNumbers<3, 1'000'000'000>,
       true},
      {"camera-preset",
       "NAME",
       "A camera that was published with a scene: cornell",
       {},
       runPreset,
       [](const std::string& a) { return checkKey(cameraPresets(), false, a); },
       true,
       rowsOf<CameraPreset, cameraPresets>},
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
