// Conjugate gradients. (A / rho) (I - M) = A / rho - A R K is symmetric for a reciprocal K; a collocated or
// counted one is nearly so, and its pairs are made symmetric: W = (A R K + (A R K)^T) / 2. Preconditioned
// with A / rho, so that residuals are unshot radiosities; black patches hold nothing and take no part. Per
// channel.
//
// A direction is what is truly unshot, made conjugate in W to the one before, and as much of it is applied as
// leaves the least unshot by K itself (minimal_residual.h, against the last few directions only). Where K is
// reciprocal this is what conjugate gradients do, in the norm of the residual.
#include "solver/first_pass.h"
#include "solver/inner_products.h"
#include "solver/minimal_residual.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr std::size_t kDirections = 8;

class ConjugateGradient final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    if (first_pass_.step(state, transport)) return 1;
    if (!product_.running()) {
      if (state.onlyRoundingUnshot()) return std::nullopt;
      if (weight_.empty()) weight_ = symmetrisingWeight(state);
      turn(state);
      product_.begin(transport, direction_, true);
    }
    const std::size_t used = product_.advance(transport);
    if (!product_.running()) finishSweep(state, transport);
    return used;
  }

 private:
  // The next direction: U, made conjugate to the last one.
  void turn(const RadiosityState& state) {
    if (image_.empty()) {
      direction_ = state.unshot();
      return;
    }
    const glm::dvec3 kept = -quotient(weighted(weight_, state.unshot(), image_), energy_);
    for (std::size_t q = 0; q < direction_.size(); ++q)
      direction_[q] = state.unshot()[q] + kept * direction_[q];
  }

  void finishSweep(RadiosityState& state, const Transport& transport) {
    // (rho / A) W p = (M p + rho / A (A R K)^T p) / 2
    image_ = reflectedMeans(transport, state.reflectance(), product_.flow().irradiance);
    for (std::size_t q = 0; q < image_.size(); ++q) {
      const glm::dvec3 back = state.reflectance()[q] / state.area()[q] * product_.gathered()[q];
      image_[q] = direction_[q] - 0.5 * (image_[q] + back);
    }
    energy_ = weighted(weight_, direction_, image_);
    minimal_.apply(state, transport, std::move(product_.flow()));
  }

  FirstPass first_pass_;
  TransportProduct product_;
  MinimalResidual minimal_{kDirections};
  std::vector<glm::dvec3> weight_, direction_, image_;  // image: of the direction by the symmetric system
  glm::dvec3 energy_{0.0};                              // of the direction in it
};

}  // namespace

std::unique_ptr<IterationMode> makeConjugateGradient() { return std::make_unique<ConjugateGradient>(); }

}  // namespace unshot
