// Weighted inner products of patch fields, channel by channel.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "solver/state.h"

namespace unshot {

/// A / rho, one per patch and channel: with it M of a reciprocal K is symmetric. 0 where rho is 0 (such a
/// patch holds nothing once its emission is shot).
inline std::vector<glm::dvec3> symmetrisingWeight(const RadiosityState& state) {
  std::vector<glm::dvec3> out(state.patchCount(), glm::dvec3(0.0));
  for (std::size_t q = 0; q < out.size(); ++q) {
    for (int c = 0; c < 3; ++c) {
      const double rho = state.reflectance()[q][c];
      if (rho > 0) out[q][c] = state.area()[q] / rho;
    }
  }
  return out;
}

inline glm::dvec3 weighted(const std::vector<glm::dvec3>& weight, const std::vector<glm::dvec3>& a,
                           const std::vector<glm::dvec3>& b) {
  glm::dvec3 sum(0.0);
  for (std::size_t q = 0; q < weight.size(); ++q) sum += weight[q] * a[q] * b[q];
  return sum;
}

/// a / b, 0 where b is 0.
inline glm::dvec3 quotient(const glm::dvec3& a, const glm::dvec3& b) {
  glm::dvec3 out(0.0);
  for (int c = 0; c < 3; ++c) out[c] = b[c] != 0 ? a[c] / b[c] : 0.0;
  return out;
}

}  // namespace unshot
