// Conjugate gradients. (A / rho) (I - M) = A / rho - A R K is symmetric for a reciprocal K; a collocated or
// counted one is nearly so, and its pairs are made symmetric: W = (A R K + (A R K)^T) / 2. Preconditioned
// with A / rho, so that residuals are unshot radiosities; black patches hold nothing and take no part. Per
// channel.
//
// What is found for W is applied with K itself: U stays the residual of the true equation. When W's residual
// has become small beside U, the iteration begins anew from U (iterative refinement). Where K is too far from
// reciprocal for that to converge, the mode ends with an Error.
#include <algorithm>

#include "solver/first_pass.h"
#include "solver/inner_products.h"
#include "solver/modes.h"

namespace unshot {
namespace {

// The iteration begins anew once its residual is this share of the true one.
constexpr double kRenewal = 0.1;
// A cycle has to bring the true residual down to this share, or two in a row have failed.
constexpr double kLeastGain = 0.9;
constexpr int kLongestCycle = 60;
// Below this share of the first residual there is only rounding.
constexpr double kRounding = 1e-14;

class ConjugateGradient final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    if (first_pass_.step(state, transport)) return 1;
    if (!product_.running()) {
      if (weight_.empty()) start(state);
      for (int c = 0; c < 3; ++c) {
        if (channels_[c].sweeps == 0) renew(c, state);
      }
      if (square_ == glm::dvec3(0.0)) return std::nullopt;
      product_.begin(transport, direction_, true);
    }
    const std::size_t used = product_.advance(transport);
    if (!product_.running()) finishSweep(state, transport);
    return used;
  }

 private:
  struct Channel {
    int sweeps = 0;          // since the iteration began anew
    int failed = 0;          // cycles that did not help
    double began_with = -1;  // square of the true residual
  };

  void start(const RadiosityState& state) {
    weight_ = symmetrisingWeight(state);
    residual_ = direction_ = state.unshot();
    first_ = weighted(weight_, state.emission(), state.emission()) +
             weighted(weight_, state.unshot(), state.unshot());
  }

  void renew(int c, const RadiosityState& state) {
    double now = 0;
    for (std::size_t q = 0; q < residual_.size(); ++q) {
      residual_[q][c] = direction_[q][c] = state.unshot()[q][c];
      now += weight_[q][c] * residual_[q][c] * residual_[q][c];
    }
    Channel& channel = channels_[c];
    if (now <= kRounding * kRounding * first_[c]) now = 0;
    if (channel.began_with >= 0 && now > kLeastGain * kLeastGain * channel.began_with &&
        ++channel.failed >= 2) {
      throw IterationFailure(
          ErrorKind::kInput,
          "conjugate gradients need reciprocal form factors (A_i F_ij = A_j F_ji); those of this scene are "
          "too far from it",
          {}, "--mode gmres");
    }
    channel.began_with = square_[c] = now;
    if (now > 0) return;
    for (glm::dvec3& d : direction_) d[c] = 0;
  }

  void finishSweep(RadiosityState& state, const Transport& transport) {
    const LightFlow& flow = product_.flow();
    const std::size_t n = state.patchCount();
    // (rho / A) W p = (M p + rho / A (A R K)^T p) / 2
    std::vector<glm::dvec3> image = reflectedMeans(transport, state.reflectance(), flow.irradiance);
    for (std::size_t q = 0; q < n; ++q) {
      const glm::dvec3 back = state.reflectance()[q] / state.area()[q] * product_.gathered()[q];
      image[q] = direction_[q] - 0.5 * (image[q] + back);
    }
    const glm::dvec3 factor = quotient(square_, weighted(weight_, direction_, image));
    state.add(factor, flow);
    for (std::size_t q = 0; q < n; ++q) residual_[q] -= factor * image[q];
    const glm::dvec3 before = square_;
    square_ = weighted(weight_, residual_, residual_);
    const glm::dvec3 kept = quotient(square_, before);
    for (std::size_t q = 0; q < n; ++q) direction_[q] = residual_[q] + kept * direction_[q];
    const glm::dvec3 truly = weighted(weight_, state.unshot(), state.unshot());
    for (int c = 0; c < 3; ++c) {
      Channel& channel = channels_[c];
      ++channel.sweeps;
      if (square_[c] <= kRenewal * kRenewal * truly[c] || channel.sweeps >= kLongestCycle) channel.sweeps = 0;
    }
  }

  FirstPass first_pass_;
  TransportProduct product_;
  std::vector<glm::dvec3> weight_, residual_, direction_;
  glm::dvec3 square_{0.0}, first_{0.0};
  Channel channels_[3];
};

}  // namespace

std::unique_ptr<IterationMode> makeConjugateGradient() { return std::make_unique<ConjugateGradient>(); }

}  // namespace unshot
