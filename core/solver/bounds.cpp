#include "solver/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <type_traits>

namespace unshot {
namespace {

// Products with the matrix in one refresh.
constexpr int kProductsAtOnce = 4, kPowerSteps = 6;
// Partial sums of (I - M)^-1 1 that are tried for a positive v - M v.
constexpr int kMostSums = 200;
// The matrix is held in single precision.
constexpr double kRounding = 4 * 6e-8;
// A weight that falls by less than this share is as good as found.
constexpr double kGain = 0.01;
// Above 1, so that an adapted comparison stays positive where U is 0.
constexpr double kAdaptedMargin = 1.25;
// Calls with one way to bound the RMS error between two that try all.
constexpr int kBetweenAllWays = 7;
// Unshot radiosity this far below 0, as a share of the largest, is rounding.
constexpr double kSignless = 1e-12;

double largest(const glm::dvec3& x) { return std::max({x.x, x.y, x.z}); }
double least(const glm::dvec3& x) { return std::min({x.x, x.y, x.z}); }
double sum(const glm::dvec3& x) { return x.x + x.y + x.z; }

// Colours one after the other as their channels. A vector of them is that in memory.
const double* channels(const std::vector<glm::dvec3>& x) { return &x.data()->x; }

// Two patches at a time: six sums side by side, which processors take in pairs or more.
struct Lanes {
  std::array<double, 6> of{};

  glm::dvec3 sums() const { return {of[0] + of[3], of[1] + of[4], of[2] + of[5]}; }
  glm::dvec3 largest() const {
    return {std::max(of[0], of[3]), std::max(of[1], of[4]), std::max(of[2], of[5])};
  }
  double sum() const {
    const glm::dvec3 x = sums();
    return x.x + x.y + x.z;
  }
};

// f(first patch, number of channels from it on).
template <class F>
void forLanes(std::size_t patches, F&& f) {
  std::size_t q = 0;
  for (; q + 1 < patches; q += 2) f(q, std::integral_constant<std::size_t, 6>());
  if (q < patches) f(q, std::integral_constant<std::size_t, 3>());
}

// v = 1 + M 1 + M^2 1 + ... until w = v - M v is positive everywhere; v and w, or nothing. `multiply(x, out)`
// is the product with M or its transpose.
template <class F>
bool positivePair(F&& multiply, std::vector<glm::dvec3>& v, std::vector<glm::dvec3>& w) {
  std::fill(v.begin(), v.end(), glm::dvec3(1.0));
  for (int k = 0; k < kMostSums; ++k) {
    multiply(v, w);
    double low = kNoBound;
    for (std::size_t q = 0; q < v.size(); ++q)
      low = std::min(low, least(1.0 - w[q] * (1 + kRounding) / v[q]));
    if (low > kRounding) {
      for (std::size_t q = 0; q < v.size(); ++q) w[q] = v[q] - w[q] * (1 + kRounding);
      return true;
    }
    for (std::size_t q = 0; q < v.size(); ++q) v[q] = 1.0 + w[q];
  }
  return false;
}

}  // namespace

ErrorBounds::ErrorBounds(const PatchMatrix& matrix, const RadiosityState& state)
    : matrix_(matrix),
      state_(state),
      counted_(state.patchCount()),
      y_(state.patchCount(), glm::dvec3(0.0)),
      norm_(matrix, state) {
  for (std::size_t q = 0; q < counted_.size(); ++q) {
    counted_[q] = state.emission()[q] == glm::dvec3(0.0);
    if (counted_[q]) counted_area_ += state.area()[q];
  }
  if (counted_area_ == 0) {  // everything emits
    all_emit_ = true;
    std::fill(counted_.begin(), counted_.end(), 1);
    counted_area_ = std::accumulate(state.area().begin(), state.area().end(), 0.0);
  }
  for (std::size_t q = 0; q < counted_.size(); ++q)
    area_counted_.push_back(counted_[q] ? state.area()[q] : 0.0);
  capTotal();
}

void ErrorBounds::multiply(const Field& x, Field& out) const {
  matrix_.product(x, out);
  for (std::size_t q = 0; q < out.size(); ++q) out[q] *= state_.reflectance()[q];
}

ErrorBounds::Field ErrorBounds::reflected(Field x) const {
  for (std::size_t q = 0; q < x.size(); ++q) x[q] *= state_.reflectance()[q];
  return x;
}

// z, and 1 where errors count.
ErrorBounds::Field ErrorBounds::countedPlus(const Field& z) const {
  Field out = z;
  for (std::size_t q = 0; q < out.size(); ++q) out[q] += counted_[q] ? 1.0 : 0.0;
  return out;
}

// A column that is not known matters unless its patch never holds anything: it reflects none, or no light
// comes.
bool ErrorBounds::allColumnsThatMatter() const {
  for (std::uint32_t q = 0; q < matrix_.size(); ++q) {
    if (matrix_.knows(q)) continue;
    if (state_.unshot()[q] != glm::dvec3(0.0)) return false;
    if (state_.reflectance()[q] != glm::dvec3(0.0) && matrix_.reaches(q)) return false;
  }
  return true;
}

// What holds whatever the columns are: none passes on more than its share of the largest reflectance.
void ErrorBounds::capTotal() {
  glm::dvec3 rho(0.0);
  for (const glm::dvec3& r : state_.reflectance()) rho = glm::max(rho, r);
  rho *= matrix_.largestSent();
  z_.clear();
  if (largest(rho) < 1) z_.assign(matrix_.size(), rho / (1.0 - rho));
  weights_stale_ = true;
}

// Where that is none, but all columns are known: a multiple of some y > M^T y.
void ErrorBounds::startTotal() {
  Field y(matrix_.size()), w(matrix_.size());
  const auto multiplyTransposed = [&](const Field& x, Field& out) { matrix_.transposed(reflected(x), out); };
  if (!positivePair(multiplyTransposed, y, w)) return;
  Field needed(matrix_.size());
  multiplyTransposed(countedPlus(Field(matrix_.size(), glm::dvec3(0.0))), needed);
  glm::dvec3 factor(0.0);
  for (std::size_t q = 0; q < y.size(); ++q) factor = glm::max(factor, needed[q] / w[q]);
  for (glm::dvec3& x : y) x *= factor * (1 + kRounding);
  z_ = std::move(y);
}

bool ErrorBounds::lowerTotal() {
  const Field x = reflected(countedPlus(z_));
  glm::dvec3 most(0.0);
  for (const glm::dvec3& value : x) most = glm::max(most, value);
  most *= matrix_.largestSent();
  double before = 0, after = 0;
  Field lower(z_.size());
  matrix_.transposed(x, lower);
  for (std::uint32_t q = 0; q < z_.size(); ++q) {
    // An unknown column that does not matter carries nothing.
    const glm::dvec3 sent = matrix_.knows(q) ? lower[q] * (1 + kRounding)
                            : complete_      ? glm::dvec3(0.0)
                                             : most;
    lower[q] = glm::min(z_[q], sent);
    before += state_.area()[q] * sum(z_[q]);
    after += state_.area()[q] * sum(lower[q]);
  }
  z_ = std::move(lower);
  return after < (1 - kGain) * before;
}

// Each step keeps y <= M^T (1 + y), for M is not negative; patches whose columns are unknown stay at 0.
void ErrorBounds::raiseTotal() {
  matrix_.transposed(reflected(countedPlus(y_)), y_);
  for (glm::dvec3& y : y_) y *= 1 - kRounding;
}

void ErrorBounds::startComparison() {
  v_.assign(matrix_.size(), glm::dvec3(1.0));
  w_.resize(matrix_.size());
  if (!positivePair([&](const Field& x, Field& out) { multiply(x, out); }, v_, w_)) {
    v_.clear();
    return;
  }
  // So that w >= 1, which lowerComparison keeps.
  double low = kNoBound;
  for (const glm::dvec3& x : w_) low = std::min(low, least(x));
  for (glm::dvec3& x : v_) x /= low;
}

// v <- min(v, 1 + M v) keeps w >= 1.
bool ErrorBounds::lowerComparison() {
  Field image(v_.size());
  multiply(v_, image);
  double before = 0, after = 0;
  for (std::size_t q = 0; q < v_.size(); ++q) {
    before += state_.area()[q] * sum(v_[q]);
    v_[q] = glm::min(v_[q], 1.0 + image[q] * (1 + kRounding));
    after += state_.area()[q] * sum(v_[q]);
  }
  return after < (1 - kGain) * before;
}

// Steps of the power method; min and max of (M x) / x bracket the radius for every positive x.
void ErrorBounds::bracketRadius() {
  if (spectral_.size() != matrix_.size()) spectral_ = state_.reflectance();
  Field image(spectral_.size());
  radius_lower_ = glm::dvec3(0.0);
  radius_upper_ = glm::dvec3(kNoBound);
  for (int k = 0; k < kPowerSteps; ++k) {
    multiply(spectral_, image);
    for (int c = 0; c < 3; ++c) {
      double low = kNoBound, high = 0, most = 0;
      for (std::size_t q = 0; q < image.size(); ++q) {
        most = std::max(most, image[q][c]);
        if (spectral_[q][c] <= 0) continue;
        low = std::min(low, image[q][c] / spectral_[q][c]);
        high = std::max(high, image[q][c] / spectral_[q][c]);
      }
      radius_lower_[c] = std::max(radius_lower_[c], low < kNoBound ? low : 0);
      radius_upper_[c] = std::min(radius_upper_[c], high);
      for (std::size_t q = 0; q < image.size(); ++q) spectral_[q][c] = most > 0 ? image[q][c] / most : 0;
    }
  }
}

void ErrorBounds::columnChanged(std::uint32_t q) {
  if (!matrix_.knows(q)) return;
  if (y_[q] != glm::dvec3(0.0)) {
    std::fill(y_.begin(), y_.end(), glm::dvec3(0.0));
    weights_stale_ = true;
  }
  if (z_.empty()) return;
  const glm::dvec3 sent = matrix_.transposed(q, reflected(countedPlus(z_))) * (1 + kRounding);
  if (largest(sent - z_[q]) > 0) capTotal();
}

bool ErrorBounds::refresh() {
  if (version_ != matrix_.version()) {
    version_ = matrix_.version();
    complete_ = allColumnsThatMatter();
  }
  if (z_.empty() && complete_) startTotal();
  if (!complete_) v_.clear();
  if (complete_ && compared_version_ != matrix_.version()) startComparison();
  if (compared_version_ != matrix_.version()) {
    adapted_ = {};
    nearby_.clear();
  }
  raiseTotal();
  weights_stale_ = true;
  left_before_all_ = 0;
  bool gains = false;
  for (int k = 0; k < kProductsAtOnce; ++k) {
    gains = !z_.empty() && lowerTotal();
    if (!v_.empty()) gains = lowerComparison() || gains;
    if (!gains) break;
  }
  if (v_.empty()) return gains;
  w_.resize(v_.size());
  multiply(v_, w_);
  double low = kNoBound;
  for (std::size_t q = 0; q < w_.size(); ++q) {
    w_[q] = v_[q] - w_[q] * (1 + kRounding);
    low = std::min(low, least(w_[q]));
  }
  if (low <= 0) v_.clear();
  if (low > 0) compared_.set(v_, w_, *this);
  ++revision_;
  compared_version_ = matrix_.version();
  bracketRadius();
  norm_.refresh();
  return gains;
}

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
               *emission = all_emit_ ? channels(state_.emission()) : nullptr;
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
