// Which patch holds the most unshot power.
#pragma once

#include <cmath>
#include <cstdint>

#include "mesh/mesh.h"
#include "solver/state.h"

namespace unshot {

/// A_q |x|, channels summed [W].
inline double powerOf(double area, const glm::dvec3& x) {
  return area * (std::abs(x.x) + std::abs(x.y) + std::abs(x.z));
}

/// The patch with the largest weight(q) above 0; kNone where there is none.
template <class F>
std::uint32_t heaviest(std::size_t patches, F&& weight) {
  std::uint32_t best = kNone;
  double most = 0;
  for (std::uint32_t q = 0; q < patches; ++q) {
    const double w = weight(q);
    if (w <= most) continue;
    most = w;
    best = q;
  }
  return best;
}

}  // namespace unshot
