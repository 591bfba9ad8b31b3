#include "viewer/camera_views.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/text.h"

namespace unshot {
namespace {

constexpr double kFilled = 0.96;  // of the picture
// Straight down the navigator would not know what is upwards in the picture. So little aside is not seen.
constexpr double kAside = 1e-5;

constexpr std::array<AxisView, 6> kViews = {{
    {{"front", "Front", "Ctrl+1: all of the scene from the front, along \u2212z"}, 0, 0, 1},
    {{"back", "Back", "Ctrl+2: all of the scene from the back, along z"}, 0, 0, -1},
    {{"left", "Left", "Ctrl+3: all of the scene from the left, along x"}, 1, 0, 0},
    {{"right", "Right", "Ctrl+4: all of the scene from the right, along \u2212x"}, -1, 0, 0},
    {{"top", "Top", "Ctrl+5: all of the scene from above, along \u2212y"}, 0, -1, 0},
    {{"bottom", "Bottom", "Ctrl+6: all of the scene from below, along y"}, 0, 1, 0},
}};

const std::array<CameraPreset, 1> kPresets = {{
    {{"cornell", "Cornell, as published",
      "The camera of the measurements that the Cornell Program of Computer Graphics published: at 278, 273, "
      "\u2212800, along z, 35 mm before a film of 25 x 25 mm, 39.3\u00b0 high and wide"},
     {{0, 0, 0}, {556, 548.8, 559.2}},
     {{278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39.3077}},
}};

std::string point(const glm::dvec3& p) {
  return numberText(p.x) + "," + numberText(p.y) + "," + numberText(p.z);
}

}  // namespace

std::span<const AxisView> axisViews() { return kViews; }

Camera axisCamera(const AxisView& view, const Bounds& bounds, const Camera& present, double aspect) {
  const glm::dvec3 up = glm::normalize(present.up);
  const glm::dvec3 side = std::abs(up.x) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(side - glm::dot(side, up) * up);
  const glm::dvec3 ahead = glm::cross(up, right);
  const double along = view.up == 0 ? view.ahead : kAside;
  return frameBounds(
      bounds, static_cast<double>(view.right) * right + static_cast<double>(view.up) * up + along * ahead,
      present.up, present.fov_deg, aspect, kFilled, present.orthographic);
}

Camera parallelCamera(const Camera& camera, const Bounds& bounds, double aspect) {
  return frameBounds(bounds, camera.at - camera.eye, camera.up, camera.fov_deg, aspect, kFilled, true);
}

std::span<const CameraPreset> cameraPresets() { return kPresets; }

bool fits(const CameraPreset& preset, const Bounds& bounds) {
  const double near = 0.05 * preset.bounds.diagonal();
  return glm::distance(bounds.min, preset.bounds.min) < near &&
         glm::distance(bounds.max, preset.bounds.max) < near;
}

std::string cameraLines(const Camera& camera) {
  return "camera " + point(camera.eye) + "," + point(camera.at) + "," + numberText(camera.fov_deg) +
         "\nprojection " + (camera.orthographic ? "orthographic" : "perspective") + "\n";
}

std::string cameraOptions(const Camera& camera) {
  return "--eye " + point(camera.eye) + " --at " + point(camera.at) + " --up " + point(camera.up) +
         " --fov " + numberText(camera.fov_deg);
}

}  // namespace unshot
