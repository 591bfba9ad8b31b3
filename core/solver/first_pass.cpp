#include "solver/first_pass.h"

#include <glm/common.hpp>

#include "solver/brightness.h"

namespace unshot {

bool FirstPass::step(RadiosityState& state, Transport& transport) {
  if (over_) return false;
  passed_.resize(state.patchCount(), 0);
  const auto toShoot = [&](std::uint32_t q) { return glm::max(state.unshot()[q], state.emissionLeft(q)); };
  const std::uint32_t q = heaviest(state.patchCount(), [&](std::uint32_t p) {
    if (state.emissionLeft(p) != glm::dvec3(0.0)) return powerOf(state.area()[p], toShoot(p));
    // A column at hand that nothing was shot along does not say yet what light reaches.
    const bool known = transport.isKept(p) && state.shot()[p] != glm::dvec3(0.0);
    return passed_[p] || known ? 0.0 : powerOf(state.area()[p], state.unshot()[p]);
  });
  if (q == kNone) {
    over_ = true;
    return false;
  }
  passed_[q] = 1;
  const glm::dvec3 d = state.emissionLeft(q) != glm::dvec3(0.0) ? toShoot(q) : state.unshot()[q];
  state.shoot(q, d, transport.column(q));
  return true;
}

}  // namespace unshot
