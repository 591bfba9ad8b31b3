// Jacobi iteration, bounce by bounce: a sweep shoots d = U as it stood when the sweep began, patch by patch,
// so that after t sweeps B = E + M E + ... + M^t E. A patch that holds nothing is passed over.
#include <algorithm>
#include <limits>

#include "solver/bounce_series.h"
#include "solver/modes.h"

namespace unshot {
namespace {

class Jacobi final : public IterationMode {
 public:
  explicit Jacobi(std::uint64_t most_sweeps) : most_sweeps_(most_sweeps) {}

  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    for (int round = 0; round < 2; ++round) {
      for (; next_ < bounce_.size(); ++next_) {
        if (bounce_[next_] == glm::dvec3(0.0)) continue;
        const auto q = static_cast<std::uint32_t>(next_++);
        state.shoot(q, bounce_[q], transport.column(q));
        return 1;
      }
      if (sweeps_ == most_sweeps_) return std::nullopt;
      bounce_ = state.unshot();
      next_ = 0;
      note(state);
    }
    return std::nullopt;
  }

  std::vector<glm::dvec3> bouncePowers() const override { return powers_; }

 private:
  // A sweep begins. Sweeps from a state where something was shot before are no bounces.
  void note(const RadiosityState& state) {
    if (sweeps_++ == 0) {
      from_the_start_ = std::all_of(state.shot().begin(), state.shot().end(),
                                    [](const glm::dvec3& s) { return s == glm::dvec3(0.0); });
    }
    if (from_the_start_ && powers_.size() <= BounceSeries::kMost) powers_.push_back(powerOf(state, bounce_));
  }

  std::uint64_t most_sweeps_, sweeps_ = 0;
  bool from_the_start_ = false;
  std::vector<glm::dvec3> powers_;
  std::vector<glm::dvec3> bounce_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<IterationMode> makeJacobi() {
  return std::make_unique<Jacobi>(std::numeric_limits<std::uint64_t>::max());
}

std::unique_ptr<IterationMode> makeBounces(std::uint64_t bounces) {
  return std::make_unique<Jacobi>(bounces);
}

}  // namespace unshot
