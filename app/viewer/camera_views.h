// Cameras that have a name: views along the axes, and published ones.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/choice.h"
#include "render/camera.h"

namespace unshot {

/// The whole scene along an axis. What is upwards is that of the camera before; with y upwards the front is
/// seen along -z with x to the right.
struct AxisView {
  ChoiceInfo info;
  int right = 0, up = 0, ahead = 0;  ///< the direction of sight: so often each of the scene's axes
};
std::span<const AxisView> axisViews();

/// `present` gives angle, projection and upwards.
Camera axisCamera(const AxisView& view, const Bounds& bounds, const Camera& present, double aspect);

/// All of the scene, seen with parallel sights from where `camera` looks.
Camera parallelCamera(const Camera& camera, const Bounds& bounds, double aspect);

/// A camera that belongs to a scene, in the coordinates of the scene's file.
struct CameraPreset {
  ChoiceInfo info;
  Bounds bounds;  ///< of the scene
  Camera camera;
};
std::span<const CameraPreset> cameraPresets();

/// Whether the scene may be the preset's: its corners lie where they do there, to 5 % of the size.
bool fits(const CameraPreset& preset, const Bounds& bounds);

/// As lines of a script, and as options of unshot solve, which has no parallel sights.
std::string cameraLines(const Camera& camera);
std::string cameraOptions(const Camera& camera);

}  // namespace unshot
