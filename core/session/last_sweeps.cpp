#include "session/last_sweeps.h"

#include <utility>
#include <vector>

#include "solver/modes.h"

namespace unshot {

std::size_t LastSweeps::advance(RadiosityState& state, Transport& transport) {
  if (!product_.running()) {
    std::vector<glm::dvec3> d = state.unshot();
    bool any = false;
    for (std::uint32_t q = 0; q < d.size(); ++q) {
      // What an emitter has not sent of its own light goes another way.
      if (!transport.isKept(q) || state.emissionLeft(q) != glm::dvec3(0.0)) d[q] = glm::dvec3(0.0);
      any = any || d[q] != glm::dvec3(0.0);
    }
    if (!any || state.onlyRoundingUnshot()) {
      left_ = 0;
      return 0;
    }
    product_.begin(transport, std::move(d));
  }
  const std::size_t used = product_.advance(transport);
  if (!product_.running()) {
    --left_;
    try {
      minimal_.apply(state, transport, std::move(product_.flow()));
    } catch (const IterationFailure&) {
      left_ = 0;  // the state is as it was, and that was good enough
    }
  }
  return used;
}

}  // namespace unshot
