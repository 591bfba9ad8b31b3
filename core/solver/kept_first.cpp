// Southwell's relaxation by power per cost: a kept column is had for a small part of the price of a new one,
// so light goes back and forth between the patches that have shot before another one is asked. Of the modes
// that shoot patch by patch it needs the fewest columns for a given error.
#include "solver/brightness.h"
#include "solver/modes.h"

namespace unshot {
namespace {

// What shooting along a kept column costs, in new ones: 20 to 50 us against 1 to 2 ms for a hemicube column
// on two cores.
constexpr double kKeptCost = 1.0 / 32;

class KeptFirst final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    const std::uint32_t q = heaviest(state.patchCount(), [&](std::uint32_t p) {
      return powerOf(state.area()[p], state.unshot()[p]) / (transport.isKept(p) ? kKeptCost : 1);
    });
    if (q == kNone) return std::nullopt;
    const glm::dvec3 d = state.unshot()[q];
    state.shoot(q, d, transport.column(q));
    return 1;
  }
};

}  // namespace

std::unique_ptr<IterationMode> makeKeptFirst() { return std::make_unique<KeptFirst>(); }

}  // namespace unshot
