// The ambient term (Cohen et al. 1988): an estimate of what unshot light will still add to the irradiance,
// for display only.
//
// Per channel and per group of patches known to see each other, sum A U / sum A / (1 - mean rho), means
// weighted by area. Groups are joined as columns show who sees whom, so a room that no light has reached gets
// nothing.
#pragma once

#include <vector>

#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

class AmbientTerm {
 public:
  explicit AmbientTerm(std::size_t patches);

  /// Notes who receives light from patch q, which has just shot (so that its column is at hand).
  void sees(std::uint32_t q, Transport& transport);
  /// One value per patch [W/m^2].
  std::vector<glm::dvec3> values(const RadiosityState& state) const;

 private:
  std::uint32_t find(std::uint32_t q) const;

  mutable std::vector<std::uint32_t> group_;
  std::vector<char> noted_;
};

}  // namespace unshot
