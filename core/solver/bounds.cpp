#include "solver/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "solver/counted.h"
#include "solver/patch_sums.h"

namespace unshot {
namespace {

// Products with the matrix in one refresh.
constexpr int kProductsAtOnce = 4, kPowerSteps = 3;
// Partial sums of (I - M)^-1 1 that are tried for a positive v - M v.
constexpr int kMostSums = 200, kMostSumsOnTheWay = 20;
// What unknown columns send lies so much above what known ones do, that the weights need not be found anew
// for each that is a little higher.
constexpr double kSentMargin = 1.01;
// A weight that falls by less than this share is as good as found.
constexpr double kGain = 0.01;

// v = 1 + M 1 + M^2 1 + ... until w = v - M v is positive everywhere; v and w, or nothing. `multiply(x, out)`
// is the product with M or its transpose.
template <class F>
bool positivePair(F&& multiply, int most_sums, std::vector<glm::dvec3>& v, std::vector<glm::dvec3>& w) {
  std::fill(v.begin(), v.end(), glm::dvec3(1.0));
  for (int k = 0; k < most_sums; ++k) {
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
    : matrix_(matrix), state_(state), y_(state.patchCount(), glm::dvec3(0.0)), norm_(matrix, state) {
  count(whereErrorsCount(state.emission(), state.reflectance()));
}

// All that was found for other counted patches is void.
void ErrorBounds::count(std::vector<char> counted) {
  counted_ = std::move(counted);
  area_counted_.assign(counted_.size(), 0.0);
  counted_area_ = 0;
  emitters_count_ = false;
  for (std::size_t q = 0; q < counted_.size(); ++q) {
    if (!counted_[q]) continue;
    area_counted_[q] = state_.area()[q];
    counted_area_ += state_.area()[q];
    emitters_count_ = emitters_count_ || state_.emission()[q] != glm::dvec3(0.0);
  }
  std::fill(y_.begin(), y_.end(), glm::dvec3(0.0));
  capTotal();
}

// Where no light comes to what emits nothing, errors of what emitters reflect are all there are.
void ErrorBounds::countEmittersWhereNoLightLeaves() {
  if (emitters_count_) return;
  for (std::uint32_t q = 0; q < counted_.size(); ++q) {
    if (counted_[q] && matrix_.reaches(q)) return;
  }
  count(std::vector<char>(counted_.size(), 1));
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

// out = M^T x for reflected = R x. An unknown column that does not matter carries nothing.
void ErrorBounds::transposed(const Field& reflected, Field& out) const {
  glm::dvec3 most(0.0);
  if (!complete_) {
    for (const glm::dvec3& value : reflected) most = glm::max(most, value);
  }
  matrix_.transposed(reflected, out);
  for (std::uint32_t q = 0; q < out.size(); ++q)
    out[q] = matrix_.knows(q) ? out[q] * (1 + kRounding) : most * sent_;
}

// What holds whatever the columns are: none passes on more than its share of the largest reflectance.
void ErrorBounds::capTotal() {
  glm::dvec3 rho(0.0);
  for (const glm::dvec3& r : state_.reflectance()) rho = glm::max(rho, r);
  rho *= matrix_.largestSent();
  Field z;
  if (largest(rho) < 1) z.assign(matrix_.size(), rho / (1.0 - rho));
  setTotal(std::move(z));
}

void ErrorBounds::setTotal(Field z) {
  z_ = std::move(z);
  reflected_total_ = z_.empty() ? Field() : reflected(countedPlus(z_));
  weights_stale_ = true;
}

// Where that is none: a multiple of some y > M^T y.
void ErrorBounds::startTotal() {
  Field y(matrix_.size()), w(matrix_.size());
  const auto multiplyTransposed = [&](const Field& x, Field& out) { transposed(reflected(x), out); };
  if (!positivePair(multiplyTransposed, complete_ ? kMostSums : kMostSumsOnTheWay, y, w)) return;
  Field needed(matrix_.size());
  multiplyTransposed(countedPlus(Field(matrix_.size(), glm::dvec3(0.0))), needed);
  glm::dvec3 factor(0.0);
  for (std::size_t q = 0; q < y.size(); ++q) factor = glm::max(factor, needed[q] / w[q]);
  for (glm::dvec3& x : y) x *= factor * (1 + kRounding);
  setTotal(std::move(y));
}

bool ErrorBounds::lowerTotal() {
  double before = 0, after = 0;
  Field lower(z_.size());
  transposed(reflected_total_, lower);
  for (std::size_t q = 0; q < z_.size(); ++q) {
    lower[q] = glm::min(z_[q], lower[q]);
    before += state_.area()[q] * sum(z_[q]);
    after += state_.area()[q] * sum(lower[q]);
  }
  setTotal(std::move(lower));
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
  if (!positivePair([&](const Field& x, Field& out) { multiply(x, out); }, kMostSums, v_, w_)) {
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
  const glm::dvec3 sent = matrix_.transposed(q, reflected_total_) * (1 + kRounding);
  if (largest(sent - z_[q]) > 0) capTotal();
}

bool ErrorBounds::refresh() {
  if (version_ != matrix_.version()) {
    version_ = matrix_.version();
    complete_ = allColumnsThatMatter();
    if (complete_) countEmittersWhereNoLightLeaves();
    const double sent = matrix_.usuallySent();
    if (sent > sent_) {
      sent_ = sent * kSentMargin;
      capTotal();
    }
  }
  if (z_.empty()) startTotal();
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

}  // namespace unshot
