// The ambient term (Cohen et al. 1988): an estimate of what unshot light will still add to the irradiance,
// for display only.
//
// Per channel and per group of patches known to see each other, sum A U / sum A / (1 - mean rho), means
// weighted by area. Groups begin as the mesh shows who faces the same air, and are joined as columns show who
// sees whom, so a room that no light has reached gets nothing. Nor does one in which light is taken back, as
// after an edit: that is to go where the light went, and not from all places alike.
#pragma once

#include <span>
#include <vector>

#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

class AmbientTerm {
 public:
  /// `air`: the groups known beforehand (Mesh::patch_air), one per patch: the index of a patch of its group.
  /// Empty: none.
  explicit AmbientTerm(std::size_t patches, std::span<const std::uint32_t> air = {});

  /// Notes who receives light from patch q, whose column this is.
  void sees(std::uint32_t q, const Column& column, const Receivers& receivers);
  /// One value per patch [W/m^2].
  std::vector<glm::dvec3> values(const RadiosityState& state) const;

 private:
  std::uint32_t find(std::uint32_t q) const;

  mutable std::vector<std::uint32_t> group_;
  std::vector<char> noted_;
};

}  // namespace unshot
