// Ambient overshooting (Feda and Purgathofer 1992): a patch shoots what it holds and what it expects still to
// receive, d = U_q + rho_q (ambient term), so that most patches shoot once. What was shot too much comes back
// as negative unshot light.
//
// Safeguard: the expectation is a share of the ambient term, 1 at first. Where the unshot power has not
// fallen over a pass, the share is halved, and below 1/16 it is 0: that is southwell, which never diverges.
#include <algorithm>

#include "solver/ambient.h"
#include "solver/brightness.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr double kLeastShare = 1.0 / 16;
// A pass has to bring the unshot power down to this share, and no shot may bring it so far above the lowest
// yet.
constexpr double kLeastGain = 0.9, kMostRise = 1.5;

class Overshoot final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    if (!ambient_) start(state);
    watch(state);
    const std::vector<glm::dvec3> expected = share_ > 0 ? ambient_->values(state) : std::vector<glm::dvec3>();
    const auto amount = [&](std::uint32_t q) {
      // What a patch sees is not known before it has shot.
      if (share_ == 0 || !shot_[q]) return state.unshot()[q];
      return state.unshot()[q] + share_ * state.reflectance()[q] * expected[q];
    };
    const std::uint32_t q =
        heaviest(state.patchCount(), [&](std::uint32_t p) { return powerOf(state.area()[p], amount(p)); });
    if (q == kNone) return std::nullopt;
    const Column& column = transport.column(q);
    glm::dvec3 d = state.unshot()[q];
    if (share_ > 0) {
      ambient_->sees(q, column, transport.receivers());
      shot_[q] = 1;
      d += share_ * state.reflectance()[q] * ambient_->values(state)[q];
    }
    state.shoot(q, d, column);
    return 1;
  }

 private:
  void start(const RadiosityState& state) {
    ambient_.emplace(state.patchCount());
    shot_.assign(state.patchCount(), 0);
    watched_ = lowest_ = state.unshotPower();
  }

  void watch(const RadiosityState& state) {
    if (share_ == 0) return;
    const double now = state.unshotPower();
    lowest_ = std::min(lowest_, now);
    const bool pass_ends = ++since_ >= state.patchCount();
    const bool fails = now > kMostRise * lowest_ || (pass_ends && now > kLeastGain * watched_);
    if (fails) {
      share_ = share_ / 2 < kLeastShare ? 0 : share_ / 2;
      lowest_ = now;
    }
    if (!fails && !pass_ends) return;
    watched_ = now;
    since_ = 0;
  }

  std::optional<AmbientTerm> ambient_;
  std::vector<char> shot_;
  double share_ = 1, watched_ = 0, lowest_ = 0;
  std::size_t since_ = 0;
};

}  // namespace

std::unique_ptr<IterationMode> makeOvershoot() { return std::make_unique<Overshoot>(); }

}  // namespace unshot
