// Where a picture is taken from. Everything here is in the scene's own frame (Mesh::vertices,
// Scene::positions); callers that hold the file's coordinates subtract Mesh::frame_origin from points first.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace unshot {

struct Camera {
  glm::dvec3 eye{0, 0, 1};
  glm::dvec3 at{0.0};
  glm::dvec3 up{0, 1, 0};  ///< need not be orthogonal to the line of sight
  double fov_deg = 40;     ///< vertical angle of view
};

struct Bounds {
  glm::dvec3 min{0.0}, max{0.0};
  glm::dvec3 centre() const { return 0.5 * (min + max); }
  double diagonal() const;
  /// k = 0..7.
  glm::dvec3 corner(int k) const;
};

/// Orthonormal, right-handed: right x up points at the viewer (-forward).
struct ViewBasis {
  glm::dvec3 right, up, forward;
};

/// The camera's axes; where `up` is along the line of sight (or zero), another is taken.
ViewBasis viewBasis(const Camera& camera);

/// The direction (unit length) in which the camera sees `at` in a picture of this aspect (width / height): a
/// place in units of its width and height, [0, 1] from left and top.
glm::dvec3 sightAt(const Camera& camera, double aspect, const glm::dvec2& at);
/// Where in such a picture the point is; nothing for one behind the eye.
std::optional<glm::dvec2> placeInPicture(const Camera& camera, double aspect, const glm::dvec3& point);

/// A rectangle of the picture, in units of its width and height: [0, 1] from left and bottom.
struct FrameWindow {
  glm::dvec2 min{0.0}, max{1.0};
};

/// How depth lies in clip space.
enum class DepthRange {
  kUsual,     ///< -1 at the near plane, 1 at the far one
  kReversed,  ///< 1 at the near plane, towards 0 far away: floats sort at any distance as finely as near by
};

/// Scene frame to clip coordinates for `window` of a picture of this aspect (width / height). Near and far
/// planes hold everything inside `bounds` that is in front of the eye, at any scale: from 1/10,000 of the
/// depth on, with reversed depth from a millionth on.
glm::mat4 viewProjection(const Camera& camera, double aspect, const Bounds& bounds,
                         const FrameWindow& window = {}, DepthRange depth = DepthRange::kUsual);

/// A camera outside `bounds` that looks along `direction` with the whole of the bounds in the frame, as close
/// as possible. `fill` is the part of the frame used, 0..1.
Camera frameBounds(const Bounds& bounds, const glm::dvec3& direction, const glm::dvec3& up, double fov_deg,
                   double aspect, double fill);

}  // namespace unshot
