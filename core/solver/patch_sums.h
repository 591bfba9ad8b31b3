// Sums over the channels of many patches, for bounds of the solver's error.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <type_traits>
#include <vector>

namespace unshot {

// The matrix is held in single precision.
inline constexpr double kRounding = 4 * 6e-8;

inline double largest(const glm::dvec3& x) { return std::max({x.x, x.y, x.z}); }
inline double least(const glm::dvec3& x) { return std::min({x.x, x.y, x.z}); }
inline double sum(const glm::dvec3& x) { return x.x + x.y + x.z; }

// Colours one after the other as their channels. A vector of them is that in memory.
inline const double* channels(const std::vector<glm::dvec3>& x) { return &x.data()->x; }

// Two patches at a time: six sums side by side, which processors take in pairs or more.
struct Lanes {
  std::array<double, 6> of{};

  glm::dvec3 sums() const { return {of[0] + of[3], of[1] + of[4], of[2] + of[5]}; }
  glm::dvec3 largest() const {
    return {std::max(of[0], of[3]), std::max(of[1], of[4]), std::max(of[2], of[5])};
  }
  double sum() const {
    const glm::dvec3 x = sums();
    return x.x + x.y + x.z;
  }
};

// f(first patch, number of channels from it on).
template <class F>
void forLanes(std::size_t patches, F&& f) {
  std::size_t q = 0;
  for (; q + 1 < patches; q += 2) f(q, std::integral_constant<std::size_t, 6>());
  if (q < patches) f(q, std::integral_constant<std::size_t, 3>());
}

}  // namespace unshot
