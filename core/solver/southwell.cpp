// Progressive refinement: Southwell's relaxation (1940) applied to radiosity (Cohen, Chen, Wallace and
// Greenberg 1988; Gortler, Cohen and Slusallek 1994). The patch with the largest A_q |U_q|, channels summed,
// shoots all of U_q.
#include <cmath>

#include "solver/modes.h"

namespace unshot {
namespace {

class Southwell final : public IterationMode {
 public:
  std::optional<std::uint32_t> step(RadiosityState& state, Transport& transport) override {
    std::uint32_t brightest = 0;
    double most = 0;
    for (std::uint32_t q = 0; q < state.patchCount(); ++q) {
      const glm::dvec3& u = state.unshot()[q];
      const double power = state.area()[q] * (std::abs(u.x) + std::abs(u.y) + std::abs(u.z));
      if (power > most) {
        most = power;
        brightest = q;
      }
    }
    if (most == 0) return std::nullopt;
    const glm::dvec3 d = state.unshot()[brightest];
    state.shoot(brightest, d, transport.column(brightest));
    return brightest;
  }
};

}  // namespace

std::unique_ptr<IterationMode> makeSouthwell() { return std::make_unique<Southwell>(); }

}  // namespace unshot
