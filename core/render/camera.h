// Where a picture is taken from. Everything here is in the scene's own frame (Mesh::vertices,
// Scene::positions); callers that hold the file's coordinates subtract Mesh::frame_origin from points first.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace unshot {

struct Camera {
  glm::dvec3 eye{0, 0, 1};
  glm::dvec3 at{0.0};
  glm::dvec3 up{0, 1, 0};  ///< need not be orthogonal to the line of sight
  double fov_deg = 40;     ///< vertical angle of view
  /// Parallel sights: the picture is as high as a perspective one is at the distance of `at`. What is behind
  /// the eye is seen too.
  bool orthographic = false;
  bool operator==(const Camera&) const = default;
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

/// A ray, `along` of unit length.
struct Sight {
  glm::dvec3 from, along;
};

/// What the camera sees at `at` in a picture of this aspect (width / height): a place in units of its width
/// and height, [0, 1] from left and top. Where sights are parallel they begin before all of `bounds`.
Sight sightAt(const Camera& camera, double aspect, const Bounds& bounds, const glm::dvec2& at);
/// Half of the height of what is seen at this depth before the eye.
double halfHeight(const Camera& camera, double depth);
/// The eye in homogeneous coordinates: from `p` the way to it is xyz - w p, which for parallel sights is
/// as long as `bounds` are.
glm::vec4 homogeneousEye(const Camera& camera, const Bounds& bounds);
/// Where in such a picture the point is; nothing for one behind the eye of a perspective one.
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
/// depth on, with reversed depth from a millionth on. Those of parallel sights hold all of `bounds`.
glm::mat4 viewProjection(const Camera& camera, double aspect, const Bounds& bounds,
                         const FrameWindow& window = {}, DepthRange depth = DepthRange::kUsual);

/// A camera outside `bounds` that looks along `direction` with the whole of the bounds in the frame, as close
/// as possible. `fill` is the part of the frame used, 0..1.
Camera frameBounds(const Bounds& bounds, const glm::dvec3& direction, const glm::dvec3& up, double fov_deg,
                   double aspect, double fill, bool orthographic = false);

}  // namespace unshot
