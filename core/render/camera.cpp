#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace unshot {
namespace {

// Of the farthest depth: what 24 bits can still sort; floats from 1 down to 0 sort anything.
constexpr double kNearestDepth = 1e-4;
constexpr double kNearestReversedDepth = 1e-6;

glm::dvec3 anyNormalTo(const glm::dvec3& v) {
  const glm::dvec3 axis = std::abs(v.x) < std::abs(v.z) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  return glm::normalize(glm::cross(v, axis));
}

double tanHalf(double fov_deg) { return std::tan(0.5 * fov_deg * glm::pi<double>() / 180.0); }

/// Of the corners of bounds, before the eye.
struct Depths {
  double nearest = std::numeric_limits<double>::max(), farthest = std::numeric_limits<double>::lowest();
};

Depths depths(const Camera& camera, const ViewBasis& basis, const Bounds& bounds) {
  Depths out;
  for (int k = 0; k < 8; ++k) {
    const double along = glm::dot(bounds.corner(k) - camera.eye, basis.forward);
    out.nearest = std::min(out.nearest, along);
    out.farthest = std::max(out.farthest, along);
  }
  return out;
}

}  // namespace

double Bounds::diagonal() const { return glm::length(max - min); }

glm::dvec3 Bounds::corner(int k) const {
  return {k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z};
}

ViewBasis viewBasis(const Camera& camera) {
  const glm::dvec3 sight = camera.at - camera.eye;
  const double length = glm::length(sight);
  ViewBasis basis;
  basis.forward = length > 0 ? sight / length : glm::dvec3(0, 0, -1);
  const double up_length = glm::length(camera.up);
  const glm::dvec3 side = up_length > 0 ? glm::cross(basis.forward, camera.up / up_length) : glm::dvec3(0.0);
  const double side_length = glm::length(side);
  basis.right = side_length > 1e-6 ? side / side_length : anyNormalTo(basis.forward);
  basis.up = glm::cross(basis.right, basis.forward);
  return basis;
}

double halfHeight(const Camera& camera, double depth) {
  return tanHalf(camera.fov_deg) * (camera.orthographic ? glm::length(camera.at - camera.eye) : depth);
}

Sight sightAt(const Camera& camera, double aspect, const Bounds& bounds, const glm::dvec2& at) {
  const ViewBasis basis = viewBasis(camera);
  const double half = halfHeight(camera, 1);
  const glm::dvec3 aside = (2 * at.x - 1) * half * aspect * basis.right + (1 - 2 * at.y) * half * basis.up;
  if (!camera.orthographic) return {camera.eye, glm::normalize(basis.forward + aside)};
  const double begin = depths(camera, basis, bounds).nearest - 0.01 * bounds.diagonal();
  return {camera.eye + aside + begin * basis.forward, basis.forward};
}

glm::vec4 homogeneousEye(const Camera& camera, const Bounds& bounds) {
  if (!camera.orthographic) return glm::vec4(camera.eye, 1.0);
  return glm::vec4(-bounds.diagonal() * viewBasis(camera).forward, 0.0);
}

std::optional<glm::dvec2> placeInPicture(const Camera& camera, double aspect, const glm::dvec3& point) {
  const ViewBasis basis = viewBasis(camera);
  const glm::dvec3 sight = point - camera.eye;
  const double depth = glm::dot(sight, basis.forward);
  if (!camera.orthographic && !(depth > 0)) return std::nullopt;
  const double height = 2 * halfHeight(camera, depth);
  return glm::dvec2(0.5 + glm::dot(sight, basis.right) / (height * aspect),
                    0.5 - glm::dot(sight, basis.up) / height);
}

namespace {

glm::dmat4 perspective(const Depths& depths, const glm::dvec2& tan, bool reversed) {
  const double farthest = depths.farthest > 0 ? depths.farthest : 1;  // all is behind the eye: any will do
  const double far_plane = 1.001 * farthest;
  const double near_plane =
      std::max(0.999 * depths.nearest, (reversed ? kNearestReversedDepth : kNearestDepth) * farthest);
  glm::dmat4 projection(0.0);
  projection[0][0] = 1 / tan.x;
  projection[1][1] = 1 / tan.y;
  projection[2][3] = -1;
  if (reversed) {
    projection[3][2] = near_plane;  // depth = near / distance: the far plane is at infinity
  } else {
    projection[2][2] = (far_plane + near_plane) / (near_plane - far_plane);
    projection[3][2] = 2 * far_plane * near_plane / (near_plane - far_plane);
  }
  return projection;
}

/// `margin` is left before the nearest and behind the farthest: lines are pulled to the eye.
glm::dmat4 orthographic(const Depths& depths, const glm::dvec2& half, double margin, bool reversed) {
  const double middle = 0.5 * (depths.nearest + depths.farthest);
  const double reach = 0.5 * (depths.farthest - depths.nearest) + margin;
  glm::dmat4 projection(1.0);
  projection[0][0] = 1 / half.x;
  projection[1][1] = 1 / half.y;
  // From -1 at the near plane to 1; reversed from 1 to 0.
  projection[2][2] = (reversed ? 0.5 : -1.0) / reach;
  projection[3][2] = (reversed ? 0.5 : -1.0) * middle / reach + (reversed ? 0.5 : 0.0);
  return projection;
}

}  // namespace

glm::mat4 viewProjection(const Camera& camera, double aspect, const Bounds& bounds, const FrameWindow& window,
                         DepthRange depth) {
  const ViewBasis basis = viewBasis(camera);
  glm::dmat4 view(1.0);
  for (int i = 0; i < 3; ++i) {
    view[i][0] = basis.right[i];
    view[i][1] = basis.up[i];
    view[i][2] = -basis.forward[i];
  }
  view[3] = glm::dvec4(-glm::dot(basis.right, camera.eye), -glm::dot(basis.up, camera.eye),
                       glm::dot(basis.forward, camera.eye), 1.0);

  const double half = halfHeight(camera, 1);
  const bool reversed = depth == DepthRange::kReversed;
  const glm::dvec2 halves(half * aspect, half);
  const Depths corners = depths(camera, basis, bounds);
  const double margin = std::max(0.02 * bounds.diagonal(), 1e-30);
  const glm::dmat4 projection = camera.orthographic ? orthographic(corners, halves, margin, reversed)
                                                    : perspective(corners, halves, reversed);

  // The window of the frame becomes the whole of clip space.
  const glm::dvec2 size = window.max - window.min;
  const glm::dvec2 middle = window.max + window.min - 1.0;  // in -1..1
  glm::dmat4 crop(1.0);
  crop[0][0] = 1 / size.x;
  crop[1][1] = 1 / size.y;
  crop[3][0] = -middle.x / size.x;
  crop[3][1] = -middle.y / size.y;
  return glm::mat4(crop * projection * view);
}

Camera frameBounds(const Bounds& bounds, const glm::dvec3& direction, const glm::dvec3& up, double fov_deg,
                   double aspect, double fill, bool orthographic) {
  Camera camera;
  camera.up = up;
  camera.fov_deg = fov_deg;
  camera.orthographic = orthographic;
  camera.at = bounds.centre();
  const glm::dvec3 forward = glm::normalize(direction);
  camera.eye = camera.at - forward * std::max(bounds.diagonal(), 1e-30);
  const ViewBasis basis = viewBasis(camera);
  const double tan_y = fill * tanHalf(fov_deg);
  const double tan_x = tan_y * aspect;
  if (orthographic) {
    double half = 1e-3 * tan_y * std::max(bounds.diagonal(), 1e-30);
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 p = bounds.corner(k) - camera.at;
      half = std::max({half, std::abs(glm::dot(p, basis.right)) / aspect, std::abs(glm::dot(p, basis.up))});
    }
    camera.eye = camera.at - forward * (half / tan_y);
    return camera;
  }
  // Alternate between the distance that shows every corner and the sideways shift that centres them.
  double distance = 0;
  for (int round = 0; round < 8; ++round) {
    distance = 0;
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 p = bounds.corner(k) - camera.at;
      const double depth = glm::dot(p, basis.forward);
      distance = std::max({distance, std::abs(glm::dot(p, basis.right)) / tan_x - depth,
                           std::abs(glm::dot(p, basis.up)) / tan_y - depth});
    }
    glm::dvec2 lowest(std::numeric_limits<double>::max());
    glm::dvec2 highest(-std::numeric_limits<double>::max());
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 p = bounds.corner(k) - camera.at;
      const double depth = std::max(distance + glm::dot(p, basis.forward), 1e-9 * distance + 1e-300);
      const glm::dvec2 screen(glm::dot(p, basis.right) / depth, glm::dot(p, basis.up) / depth);
      lowest = glm::min(lowest, screen);
      highest = glm::max(highest, screen);
    }
    const glm::dvec2 middle = 0.5 * (lowest + highest);
    if (round < 7) camera.at += 0.7 * distance * (middle.x * basis.right + middle.y * basis.up);
  }
  camera.eye = camera.at - forward * std::max(distance, 1e-3 * bounds.diagonal());
  return camera;
}

}  // namespace unshot
