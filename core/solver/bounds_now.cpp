// The bounds of the present state, from what the matrix has given so far.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "solver/bounds.h"
#include "solver/patch_sums.h"

namespace unshot {
namespace {

// Above 1, so that an adapted comparison stays positive where U is 0.
constexpr double kAdaptedMargin = 1.25;
// Calls with one way to bound the RMS error between two that try all.
constexpr int kBetweenAllWays = 7;
// Unshot radiosity this far below 0, as a share of the largest, is rounding.
constexpr double kSignless = 1e-12;

}  // namespace

double ErrorBounds::rmsCounted(const Field& x) const {
  double squares = 0;
  for (std::size_t q = 0; q < x.size(); ++q) {
    if (counted_[q]) squares += state_.area()[q] * sum(x[q] * x[q]);
  }
  return rmsOf(squares);
}

double ErrorBounds::rmsOf(double squares) const {
  return counted_area_ > 0 ? std::sqrt(squares / (3 * counted_area_)) : 0;
}

// z and y in single precision, rounded to the safe side.
void ErrorBounds::weightTotals() {
  weights_stale_ = false;
  const std::size_t n = state_.patchCount();
  upper_weights_.assign(3 * n, 1.0f);  // without z: whether U is below 0 somewhere
  lower_weights_.assign(3 * n, 0.0f);
  for (std::size_t q = 0; q < n; ++q) {
    const double area = state_.area()[q] / counted_area_;
    for (int c = 0; c < 3; ++c) {
      lower_weights_[3 * q + c] = static_cast<float>(area * y_[q][c] * (1 - kRounding));
      if (!z_.empty())
        upper_weights_[3 * q + c] =
            static_cast<float>(area * z_[q][c] * (1 + kRounding)) + std::numeric_limits<float>::min();
    }
  }
}

// Each step of a solve comes here.
ErrorBounds::Sums ErrorBounds::sumsNow() const {
  const double *u = channels(state_.unshot()), *shot = channels(state_.shot()),
               *emission = emitters_count_ ? channels(state_.emission()) : nullptr;
  const float *upper = upper_weights_.data(), *lower = lower_weights_.data();
  Lanes arriving, weighted, negative, reflected, squares;
  forLanes(state_.patchCount(), [&](std::size_t q, auto lanes) {
    const std::size_t at = 3 * q;
    for (std::size_t k = 0; k < lanes; ++k) {
      const double size = std::abs(u[at + k]);
      arriving.of[k] += (size + u[at + k]) * static_cast<double>(lower[at + k]);
      weighted.of[k] += size * static_cast<double>(upper[at + k]);
      negative.of[k] += (size - u[at + k]) * static_cast<double>(upper[at + k]);
    }
    for (std::size_t k = 0; k < lanes; ++k) {
      const double area = area_counted_[q + k / 3];
      const double light = shot[at + k] + u[at + k] - (emission ? emission[at + k] : 0.0);
      reflected.of[k] += area * light;
      squares.of[k] += area * light * light;
    }
  });
  return {weighted.sum() * counted_area_, negative.sum() * counted_area_ / 2,
          arriving.sum() * counted_area_ / 2, reflected.sum(), squares.sum()};
}

double ErrorBounds::totalUpper(const Sums& sums) const {
  if (z_.empty()) return kNoBound;
  // What is still to come is at least 0 where U is, so the truth reflects at least this much.
  const double truth = sums.reflected - sums.negative;
  return truth > 0 ? sums.weighted / truth : kNoBound;
}

double ErrorBounds::totalLower(const Sums& sums) const {
  if (sums.signs() && z_.empty()) return 0;
  const double missing = sums.arriving - sums.negative;
  return missing > 0 && sums.reflected >= 0 ? missing / (sums.reflected + missing) : 0;
}

// The bound for an RMS error of at most `rms`.
double ErrorBounds::upperOf(double rms, const Sums& sums) const {
  const double now = rmsOf(sums.reflected_squares);
  return now > rms ? rms / (now - rms) : kNoBound;
}

// A bound of the RMS error, where matrix and state have one of that kind.
double ErrorBounds::rmsBy(Way way) const {
  const double *u = channels(state_.unshot()), *shot = channels(state_.shot());
  const std::size_t n = state_.patchCount();
  Lanes lanes_of;
  switch (way) {
    case Way::kComparison:
      return compared_.rmsAfter(state_.unshot(), *this);
    case Way::kAdapted:
      return adapted_.rmsAfter(state_.unshot(), *this);
    case Way::kNorm: {
      const double* weight = channels(norm_.weights());
      forLanes(n, [&](std::size_t q, auto lanes) {
        for (std::size_t k = 0, at = 3 * q; k < lanes; ++k, ++at)
          lanes_of.of[k] += weight[at] * u[at] * u[at];
      });
      return rmsOf(norm_.squaresAfter(lanes_of.sums()));
    }
    case Way::kNearby: {
      if (nearby_.empty()) return kNoBound;
      const double* nearby = channels(nearby_);
      forLanes(n, [&](std::size_t q, auto lanes) {
        for (std::size_t k = 0, at = 3 * q; k < lanes; ++k, ++at) {
          const double off = nearby[at] - shot[at] - u[at];
          lanes_of.of[k] += area_counted_[q + k / 3] * off * off;
        }
      });
      return rmsOf(lanes_of.sum()) + nearby_error_;
    }
  }
  return kNoBound;
}

double ErrorBounds::tryAllWays() {
  double least_rms = kNoBound;
  for (const Way way : kWays) {
    const double rms = rmsBy(way);
    if (rms >= least_rms) continue;
    least_rms = rms;
    best_way_ = way;
  }
  left_before_all_ = kBetweenAllWays;
  return least_rms;
}

SolverBounds ErrorBounds::at() {
  if (weights_stale_) weightTotals();
  SolverBounds out;
  const Sums sums = sumsNow();
  out.total_upper = totalUpper(sums);
  out.total_lower = totalLower(sums);
  if (!comparable()) return out;
  double rms = left_before_all_-- > 0 ? rmsBy(best_way_) : kNoBound;
  // What is near stays as far from the solution as it is, while the state comes nearer.
  const bool surpassed = best_way_ == Way::kNearby && rms < 2 * nearby_error_;
  if (rms == kNoBound || surpassed) rms = tryAllWays();
  out.upper = upperOf(rms, sums);
  return out;
}

double ErrorBounds::Comparison::rmsAfter(const Field& u, const ErrorBounds& bounds) const {
  if (inverse_w.empty()) return kNoBound;
  const double *light = channels(u), *inverse = channels(inverse_w);
  Lanes most;
  forLanes(u.size(), [&](std::size_t q, auto lanes) {
    for (std::size_t k = 0, at = 3 * q; k < lanes; ++k, ++at) {
      const double ratio = std::abs(light[at]) * inverse[at];
      most.of[k] = ratio > most.of[k] ? ratio : most.of[k];
    }
  });
  const glm::dvec3 factor = most.largest();
  return bounds.rmsOf(sum(factor * factor * squares));
}

void ErrorBounds::Comparison::set(const Field& v, const Field& w, const ErrorBounds& bounds) {
  inverse_w.resize(v.size());
  squares = glm::dvec3(0.0);
  for (std::size_t q = 0; q < v.size(); ++q) {
    inverse_w[q] = 1.0 / w[q];
    const glm::dvec3 more = glm::max(v[q] - w[q], glm::dvec3(0.0));
    if (bounds.counted_[q]) squares += bounds.state_.area()[q] * more * more;
  }
}

// With signs, so that what cancels in M U counts as cancelled: e = M U + ... + M^k U + (I - M)^-1 M (M^k U).
SolverBounds ErrorBounds::sharpened(int products) {
  left_before_all_ = 0;
  SolverBounds out = at();
  if (!comparable() || products < 1) return out;
  left_before_all_ = 0;  // there will be other ways
  const std::size_t n = state_.patchCount();
  Field power = state_.unshot(), powers(n, glm::dvec3(0.0)), image(n);
  double low = 0, high = 0;
  for (const glm::dvec3& u : power) {
    low = std::min(low, least(u));
    high = std::max(high, largest(glm::abs(u)));
  }
  for (int k = 0; k < products; ++k) {
    multiply(power, image);
    std::swap(power, image);
    for (std::size_t q = 0; q < n; ++q) powers[q] += power[q];
  }
  glm::dvec3 factor(0.0), rest(0.0);
  for (std::size_t q = 0; q < n; ++q) {
    factor = glm::max(factor, glm::abs(power[q]) / w_[q]);
    rest += norm_.weights()[q] * power[q] * power[q];
  }
  Field above(n);
  for (std::size_t q = 0; q < n; ++q) {
    above[q] = glm::abs(powers[q]) * (1 + kRounding) + factor * glm::max(v_[q] - w_[q], glm::dvec3(0.0));
  }
  nearby_.resize(n);
  for (std::size_t q = 0; q < n; ++q) nearby_[q] = state_.shot()[q] + state_.unshot()[q] + powers[q];
  const double known = rmsCounted(powers), error = rmsCounted(above);
  nearby_error_ = rmsOf(norm_.squaresAfter(rest)) + known * kRounding;
  const Sums sums = sumsNow();
  out.upper = std::min(out.upper, upperOf(std::min(error, known + nearby_error_), sums));
  adapted_ = {};
  if (low < -kSignless * high) return out;
  const double now = rmsOf(sums.reflected_squares);
  if (now + error > 0) out.lower = known * (1 - kRounding) / (now + error);
  // U >= 0: x = U + M U + ... + M^(k-1) U + factor v is a comparison of U's own shape, (I - M) x = U - M^k U
  // + factor w, which is U at least; for the steps that follow, until U has another shape.
  Field v(n), w(n);
  factor *= kAdaptedMargin;
  for (std::size_t q = 0; q < n; ++q) {
    const glm::dvec3 u = glm::max(state_.unshot()[q], glm::dvec3(0.0));
    v[q] = u + powers[q] - power[q] + factor * v_[q];
    w[q] = (u - power[q] + factor * w_[q]) - kRounding * v[q];
    for (int c = 0; c < 3; ++c) {
      if (factor[c] == 0) {  // nothing unshot in this channel
        v[q][c] = v_[q][c];
        w[q][c] = w_[q][c];
      }
      if (w[q][c] <= 0) return out;
    }
  }
  adapted_.set(v, w, *this);
  return out;
}

}  // namespace unshot
