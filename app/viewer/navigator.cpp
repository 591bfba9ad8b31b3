#include "viewer/navigator.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace unshot {
namespace {

constexpr double kCrossingSeconds = 5;  // to fly along the scene's diagonal
constexpr double kFast = 4;
constexpr double kSettleSeconds = 0.08;  // time constant of the velocity
constexpr double kSteepest = 0.4995 * glm::pi<double>();
constexpr double kLookPerFov = 1.5;  // fields of view turned by a drag across the height
constexpr double kZoomPerNotch = 6.0 / 7.0;
constexpr double kNearestTarget = 0.02;  // of the scene's size
constexpr double kNearestParallel = 1e-4;

glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
         (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

double unitsPerPixel(const Camera& camera, double height) {
  const double distance = glm::length(camera.at - camera.eye);
  return 2 * distance * std::tan(camera.fov_deg * glm::pi<double>() / 360) / std::max(height, 1.0);
}

}  // namespace

void Navigator::reset(const Camera& camera, const Bounds& bounds) {
  camera_ = camera;
  const double length = glm::length(camera.up);
  camera_.up = length > 0 ? camera.up / length : glm::dvec3(0, 1, 0);
  const double diagonal = bounds.diagonal();
  size_ = diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1;
  wanted_ = velocity_ = glm::dvec3(0.0);
}

void Navigator::turn(const glm::dvec2& angles, bool around_target) {
  const glm::dvec3 sight = camera_.at - camera_.eye;
  const ViewBasis basis = viewBasis(camera_);
  const double pitch = std::asin(std::clamp(glm::dot(basis.forward, camera_.up), -1.0, 1.0));
  const double new_pitch = std::clamp(pitch + angles.y, -kSteepest, kSteepest);
  glm::dvec3 turned = rotated(sight, basis.right, new_pitch - pitch);
  turned = rotated(turned, camera_.up, angles.x);
  if (around_target) {
    camera_.eye = camera_.at - turned;
  } else {
    camera_.at = camera_.eye + turned;
  }
}

void Navigator::orbit(const glm::dvec2& pixels, double height) {
  turn(-glm::pi<double>() / std::max(height, 1.0) * pixels, true);
}

void Navigator::look(const glm::dvec2& pixels, double height) {
  // The view follows the mouse, as in games.
  turn(-kLookPerFov * camera_.fov_deg * glm::pi<double>() / 180 / std::max(height, 1.0) * pixels, false);
}

void Navigator::pan(const glm::dvec2& pixels, double height) {
  const ViewBasis basis = viewBasis(camera_);
  const glm::dvec3 shift = unitsPerPixel(camera_, height) * (-pixels.x * basis.right + pixels.y * basis.up);
  camera_.eye += shift;
  camera_.at += shift;
}

void Navigator::zoom(double notches, const glm::dvec3& point) {
  const double distance = glm::length(camera_.at - camera_.eye);
  if (!(distance > 0)) return;
  const glm::dvec3 forward = (camera_.at - camera_.eye) / distance;
  const double left = std::pow(kZoomPerNotch, notches);
  if (camera_.orthographic) {
    const double closer = std::max(left * distance, kNearestParallel * size_);
    camera_.at += (1 - closer / distance) * (point - camera_.at);
    camera_.eye = camera_.at - closer * forward;
    return;
  }
  const double nearest = kNearestTarget * size_;
  const double way = glm::length(point - camera_.eye);
  const glm::dvec3 towards = way > 0 ? (point - camera_.eye) / way : forward;
  camera_.eye += (1 - left) * std::max(way, 3 * nearest) * towards;
  camera_.at = camera_.eye + std::max(left * distance, nearest) * forward;
}

double Navigator::speed() const { return speed_factor_ * size_ / kCrossingSeconds; }

void Navigator::setSpeedFactor(double factor) {
  speed_factor_ = std::clamp(factor, 1 / kSpeedRange, kSpeedRange);
}

void Navigator::fly(const glm::dvec3& direction, bool fast) {
  const double length = glm::length(direction);
  wanted_ = length > 0 ? speed() * (fast ? kFast : 1) / std::max(length, 1.0) * direction : glm::dvec3(0.0);
}

void Navigator::advance(double seconds) {
  if (!moving() || !(seconds > 0)) return;
  const double share = 1 - std::exp(-seconds / kSettleSeconds);
  velocity_ += share * (wanted_ - velocity_);
  if (glm::length(velocity_ - wanted_) < 1e-3 * speed()) velocity_ = wanted_;
  const ViewBasis basis = viewBasis(camera_);
  const glm::dvec3 aside = seconds * (velocity_.x * basis.right + velocity_.y * basis.up);
  const double ahead = seconds * velocity_.z;
  camera_.eye += aside;
  camera_.at += aside;
  if (camera_.orthographic) {
    // Going ahead would change nothing.
    const double distance = glm::length(camera_.at - camera_.eye);
    const double closer = std::max(distance * std::exp(-ahead / size_), kNearestParallel * size_);
    camera_.eye = camera_.at - closer * basis.forward;
  } else {
    camera_.eye += ahead * basis.forward;
    camera_.at += ahead * basis.forward;
  }
}

bool Navigator::moving() const { return velocity_ != glm::dvec3(0.0) || wanted_ != glm::dvec3(0.0); }

}  // namespace unshot
