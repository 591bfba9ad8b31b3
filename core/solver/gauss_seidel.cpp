// Gauss-Seidel iteration: patches in turn, each shooting all that it holds by then. Relaxing equation q of (I
// - M) S = R E changes S_q by U_q, since a flat patch does not see itself (M_qq = 0).
#include "solver/modes.h"

namespace unshot {
namespace {

class GaussSeidel final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    const std::size_t n = state.patchCount();
    for (std::size_t tried = 0; tried < n; ++tried) {
      const auto q = static_cast<std::uint32_t>(next_);
      next_ = (next_ + 1) % n;
      const glm::dvec3 d = state.unshot()[q];
      if (d == glm::dvec3(0.0)) continue;
      state.shoot(q, d, transport.column(q));
      return 1;
    }
    return std::nullopt;
  }

 private:
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<IterationMode> makeGaussSeidel() { return std::make_unique<GaussSeidel>(); }

}  // namespace unshot
