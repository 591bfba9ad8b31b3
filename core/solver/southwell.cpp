// Progressive refinement: Southwell's relaxation (1940) applied to radiosity (Cohen, Chen, Wallace and
// Greenberg 1988; Gortler, Cohen and Slusallek 1994). The patch with the largest A_q |U_q|, channels summed,
// shoots all of U_q.
#include "solver/brightness.h"
#include "solver/modes.h"

namespace unshot {
namespace {

class Southwell final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    const std::uint32_t q = heaviest(
        state.patchCount(), [&](std::uint32_t p) { return powerOf(state.area()[p], state.unshot()[p]); });
    if (q == kNone) return std::nullopt;
    const glm::dvec3 d = state.unshot()[q];
    state.shoot(q, d, transport.column(q));
    return 1;
  }
};

}  // namespace

std::unique_ptr<IterationMode> makeSouthwell() { return std::make_unique<Southwell>(); }

}  // namespace unshot
