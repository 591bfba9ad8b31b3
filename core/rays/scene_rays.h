// Single rays against the true geometry of a scene, in any order and direction (Embree, single precision,
// watertight).
//
// What is hit is placed in double precision on the triangle's own plane, so that errors of distance do not
// add up along a path. A ray that starts on a surface starts at `lifted`. Surfaces nearer to each other than
// twice the lift are not told apart.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

namespace unshot {

class SceneRays {
 public:
  struct Hit {
    std::uint32_t triangle = 0;
    bool back = false;         ///< met from behind: its corners run clockwise as seen from the ray's origin
    double distance = 0;       ///< [m]
    glm::dvec3 position{0.0};  ///< on the triangle
    glm::dvec3 normal{0.0};    ///< unit length, of the side that was met: it faces the ray's origin
  };

  struct Triangle {
    glm::dvec3 corners[3];
    glm::dvec3 normal{0.0};  ///< unit length, the corners run counter-clockwise about it; 0 without an area
    double area = 0;         ///< [m^2]
    /// `u`, `v` uniform in [0, 1) give a point uniform on the triangle.
    glm::dvec3 point(double u, double v) const;
  };

  /// `corners`: three indices into `positions` [m] per triangle. Both are copied. Throws Error
  /// (kEnvironment).
  SceneRays(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> corners);
  ~SceneRays();
  SceneRays(SceneRays&&) noexcept;
  SceneRays(const SceneRays&) = delete;
  SceneRays& operator=(const SceneRays&) = delete;

  /// The first triangle along the ray (`direction` of unit length). Any thread.
  std::optional<Hit> intersect(const glm::dvec3& origin, const glm::dvec3& direction) const;
  /// Whether some triangle meets the segment from a to b. Any thread.
  bool occluded(const glm::dvec3& a, const glm::dvec3& b) const;
  /// Which of the segments from `a` to each of `b`, at most kTogether, some triangle meets: bit k for b[k].
  /// Much sooner than one by one where they go about the same way. Any thread.
  std::uint32_t occluded(const glm::dvec3& a, std::span<const glm::dvec3> b) const;
  static constexpr std::size_t kTogether = 16;
  /// Whether the ray from there (`direction` of unit length) meets any triangle. Any thread.
  bool meetsAny(const glm::dvec3& origin, const glm::dvec3& direction) const;

  /// The point moved off the surface it lies on, along `normal` (unit length, of the side that is meant).
  glm::dvec3 lifted(const glm::dvec3& point, const glm::dvec3& normal) const;
  /// How far that is [m]: 1.5e-6 of the scene's largest coordinate (rounded up to a power of 2).
  double lift() const;

  const Triangle& triangle(std::uint32_t t) const;
  std::size_t triangleCount() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace unshot
