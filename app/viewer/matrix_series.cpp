#include "viewer/matrix_series.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace unshot {
namespace {

constexpr int kIterations = 600;
constexpr double kStays = 1e-9;  // so near a radius of 1 terms stay as they are

}  // namespace

MatrixSeries::MatrixSeries(std::vector<double> matrix, std::size_t size) : size_(size) {
  std::vector<double> one(size * size, 0.0);
  for (std::size_t i = 0; i < size; ++i) one[i * size + i] = 1;
  sums_.push_back(one);
  powers_.push_back(std::move(one));
  powers_.push_back(std::move(matrix));
  std::vector<double> x(size, 1.0);
  for (int iteration = 0; iteration < kIterations && size > 0; ++iteration) {
    std::vector<double> next = times(x);
    for (std::size_t i = 0; i < size; ++i) next[i] += x[i];
    const double most = *std::max_element(next.begin(), next.end());
    radius_ = most - 1;  // x is scaled to a largest value of 1
    for (double& value : next) value /= most;
    x = std::move(next);
  }
}

std::vector<double> MatrixSeries::times(const std::vector<double>& x) const {
  std::vector<double> out(size_, 0.0);
  for (std::size_t i = 0; i < size_; ++i) {
    for (std::size_t j = 0; j < size_; ++j) out[i] += powers_[1][i * size_ + j] * x[j];
  }
  return out;
}

SeriesTerms MatrixSeries::terms() const {
  if (std::abs(radius_ - 1) <= kStays) return SeriesTerms::kStay;
  return radius_ > 1 ? SeriesTerms::kGrow : SeriesTerms::kShrink;
}

const std::vector<double>& MatrixSeries::power(std::size_t k) {
  while (powers_.size() <= k) {
    const std::vector<double>& last = powers_.back();
    std::vector<double> next(size_ * size_, 0.0);
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t l = 0; l < size_; ++l) {
        const double m = powers_[1][i * size_ + l];
        if (m == 0) continue;
        for (std::size_t j = 0; j < size_; ++j) next[i * size_ + j] += m * last[l * size_ + j];
      }
    }
    powers_.push_back(std::move(next));
  }
  return powers_[k];
}

const std::vector<double>& MatrixSeries::sum(std::size_t k) {
  while (sums_.size() <= k) {
    std::vector<double> next = sums_.back();
    const std::vector<double>& term = power(sums_.size());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += term[i];
    sums_.push_back(std::move(next));
  }
  return sums_[k];
}

double MatrixSeries::norm(std::size_t k) {
  const std::vector<double>& m = power(k);
  double most = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    double row = 0;
    for (std::size_t j = 0; j < size_; ++j) row += m[i * size_ + j];
    most = std::max(most, row);
  }
  return most;
}

std::vector<double> MatrixSeries::light(const std::vector<double>& e, std::size_t k) const {
  std::vector<double> out = e;
  for (std::size_t t = 0; t < k; ++t) {
    std::vector<double> next = times(out);
    for (std::size_t i = 0; i < size_; ++i) next[i] += e[i];
    out = std::move(next);
  }
  return out;
}

}  // namespace unshot
