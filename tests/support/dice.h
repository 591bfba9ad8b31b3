// Repeatable random values for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "base/random.h"

namespace unshot::testing_support {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(mixBits(seed)) {}

  double uniform() { return unitInterval(mixBits(state_++)); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(uniform() * n); }
  glm::dvec3 inCube(double half) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return {x, y, z};
  }
  glm::dvec3 direction() {
    const double z = between(-1, 1), turn = between(0, 2 * std::acos(-1.0)), r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
  }
  /// Orthonormal and right-handed.
  glm::dmat3 rotation() {
    const glm::dvec3 a = direction();
    const glm::dvec3 b = glm::normalize(glm::cross(a, direction()));
    return {a, b, glm::cross(a, b)};
  }

 private:
  std::uint64_t state_;
};

}  // namespace unshot::testing_support
