// Moves the camera of the viewer: orbit, look around, pan, zoom and fly. No window, no GUI: motions in,
// camera out. Where sights are parallel, nearer means larger.
#pragma once

#include "render/camera.h"

namespace unshot {

/// Speeds follow the size of the scene. Motions of the mouse are in pixels, y downwards, of a viewport
/// `height` pixels high; the scene follows the mouse.
class Navigator {
 public:
  /// Stands at `camera`, at rest. `bounds` of the scene give the usual speed.
  void reset(const Camera& camera, const Bounds& bounds);
  const Camera& camera() const { return camera_; }
  void setAngle(double fov_deg) { camera_.fov_deg = fov_deg; }
  /// What is looked at keeps its size.
  void setOrthographic(bool orthographic) { camera_.orthographic = orthographic; }

  /// Around the point looked at; a drag across the height turns by half a turn. Stops short of the poles.
  void orbit(const glm::dvec2& pixels, double height);
  /// Looks at this point from where it stands; orbits are around it.
  void lookAt(const glm::dvec3& point) { camera_.at = point; }
  /// Turns the head.
  void look(const glm::dvec2& pixels, double height);
  /// Sideways and up, so that the point looked at stays under the mouse.
  void pan(const glm::dvec2& pixels, double height);
  /// Towards the point, which stays where it is in the picture, a seventh of the way a notch; close to it at
  /// least a small step, so that one can always go further.
  void zoom(double notches, const glm::dvec3& point);
  void zoom(double notches) { zoom(notches, camera_.at); }
  /// The velocity wanted from now on: right, up, forward, each from -1 to 1 times the speed. Reached
  /// smoothly.
  void fly(const glm::dvec3& direction, bool fast);
  /// Moves on by this time [s].
  void advance(double seconds);
  /// Whether advance() will change the camera.
  bool moving() const;

  /// Of flying [m/s].
  double speed() const;
  /// Times what is usual for the scene, from 1/kSpeedRange to kSpeedRange.
  double speedFactor() const { return speed_factor_; }
  void setSpeedFactor(double factor);
  void scaleSpeed(double factor) { setSpeedFactor(speed_factor_ * factor); }
  static constexpr double kSpeedRange = 100;

 private:
  void turn(const glm::dvec2& angles, bool around_target);

  Camera camera_;
  double size_ = 1;  // of the scene [m]
  double speed_factor_ = 1;
  glm::dvec3 wanted_{0.0}, velocity_{0.0};  // in camera axes [m/s]
};

}  // namespace unshot
