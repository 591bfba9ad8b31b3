// Jacobi iteration, bounce by bounce: a sweep shoots d = U as it stood when the sweep began, patch by patch,
// so that after t sweeps B = E + M E + ... + M^t E. A patch that holds nothing is passed over.
#include "solver/modes.h"

namespace unshot {
namespace {

class Jacobi final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    for (int round = 0; round < 2; ++round) {
      for (; next_ < bounce_.size(); ++next_) {
        if (bounce_[next_] == glm::dvec3(0.0)) continue;
        const auto q = static_cast<std::uint32_t>(next_++);
        state.shoot(q, bounce_[q], transport.column(q));
        return 1;
      }
      bounce_ = state.unshot();
      next_ = 0;
    }
    return std::nullopt;
  }

 private:
  std::vector<glm::dvec3> bounce_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<IterationMode> makeJacobi() { return std::make_unique<Jacobi>(); }

}  // namespace unshot
