// Chebyshev semi-iteration (Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1) on (I - M) S =
// R E: sweeps as jacobi's, each combined with the one before so that the error polynomial is the smallest on
// an interval that holds the spectrum of M, per channel.
//
// The interval is [-beta, beta] with beta above the spectral radius: max (M x) / x for a positive x (Collatz
// and Wielandt), after a few products M x. Safeguard: where a cycle of sweeps does not lower the unshot power
// (a K far from reciprocal has a complex spectrum), the interval is halved; at width 0 this is jacobi.
#include <algorithm>
#include <cmath>

#include "solver/first_pass.h"
#include "solver/modes.h"

namespace unshot {
namespace {

constexpr int kBoundProducts = 4;
constexpr int kCycle = 12;
constexpr double kMostBeta = 1 - 1e-7;

class Chebyshev final : public IterationMode {
 public:
  std::optional<std::size_t> step(RadiosityState& state, Transport& transport) override {
    if (first_pass_.step(state, transport)) return 1;
    if (!product_.running()) {
      if (state.onlyRoundingUnshot()) return std::nullopt;
      product_.begin(transport, bound_products_ < kBoundProducts ? startVector(state) : direction(state));
    }
    const std::size_t used = product_.advance(transport);
    if (product_.running()) return used;
    if (bound_products_ < kBoundProducts) {
      refineBound(state, transport);
    } else {
      state.add(glm::dvec3(1.0), product_.flow());
      watch(state);
    }
    return used;
  }

  std::string activity() const override {
    return bound_products_ < kBoundProducts ? "bounding the spectrum" : "";
  }

 private:
  // Positive where the patch reflects and light has come.
  std::vector<glm::dvec3> startVector(const RadiosityState& state) {
    if (!x_.empty()) return x_;
    x_ = state.reflectance();
    for (std::size_t q = 0; q < x_.size(); ++q) {
      if (state.unshot()[q] == glm::dvec3(0.0)) x_[q] = glm::dvec3(0.0);
    }
    return x_;
  }

  void refineBound(const RadiosityState& state, const Transport& transport) {
    const std::vector<glm::dvec3> mx =
        reflectedMeans(transport, state.reflectance(), product_.flow().irradiance);
    for (int c = 0; c < 3; ++c) {
      double highest = 0, largest = 0;
      for (std::size_t q = 0; q < x_.size(); ++q) {
        if (x_[q][c] > 0) highest = std::max(highest, mx[q][c] / x_[q][c]);
        largest = std::max(largest, mx[q][c]);
      }
      beta_[c] = std::min(highest, kMostBeta);
      // A part of x is kept, so that it stays positive where little light comes.
      for (std::size_t q = 0; q < x_.size(); ++q) {
        if (x_[q][c] > 0 && largest > 0) x_[q][c] = 0.9 * mx[q][c] / largest + 0.1 * x_[q][c];
      }
    }
    ++bound_products_;
  }

  // The next d: U first, then the recurrence.
  std::vector<glm::dvec3> direction(const RadiosityState& state) {
    const glm::dvec3 half = width_ * beta_;
    if (sweep_ == 0) {
      d_ = state.unshot();
      ratio_ = half;  // 1 / sigma with theta = 1
    } else {
      // rho' = 1 / (2 sigma - rho), multiplied out so that half = 0 needs no case of its own.
      const glm::dvec3 next = half / (2.0 - half * ratio_);
      const glm::dvec3 scale = 2.0 / (2.0 - half * ratio_);
      for (std::size_t q = 0; q < d_.size(); ++q) d_[q] = next * ratio_ * d_[q] + scale * state.unshot()[q];
      ratio_ = next;
    }
    ++sweep_;
    return d_;
  }

  void watch(const RadiosityState& state) {
    if (sweep_ % kCycle != 0) return;
    const double now = state.unshotPower();
    if (watched_ >= 0 && now > watched_) {
      width_ = width_ > 0.05 ? width_ / 2 : 0;
      sweep_ = 0;
    }
    watched_ = now;
  }

  FirstPass first_pass_;
  TransportProduct product_;
  int bound_products_ = 0, sweep_ = 0;
  std::vector<glm::dvec3> x_, d_;
  glm::dvec3 beta_{0.0}, ratio_{0.0};
  double width_ = 1, watched_ = -1;
};

}  // namespace

std::unique_ptr<IterationMode> makeChebyshev() { return std::make_unique<Chebyshev>(); }

}  // namespace unshot
