// The series I + M + M^2 + ... of a small matrix, for lectures: its powers, partial sums and how they grow.
#pragma once

#include <cstddef>
#include <vector>

namespace unshot {

enum class SeriesTerms { kShrink, kStay, kGrow };

/// A square matrix, row by row, no entry below 0.
class MatrixSeries {
 public:
  static constexpr std::size_t kMost = 64;  ///< the highest power

  MatrixSeries() = default;
  MatrixSeries(std::vector<double> matrix, std::size_t size);

  std::size_t size() const { return size_; }
  /// M^k, k up to kMost; worked out once.
  const std::vector<double>& power(std::size_t k);
  /// I + M + ... + M^k.
  const std::vector<double>& sum(std::size_t k);
  /// The largest row sum of M^k: what it makes of 1 everywhere, at most.
  double norm(std::size_t k);
  /// (I + M + ... + M^k) e.
  std::vector<double> light(const std::vector<double>& e, std::size_t k) const;
  /// The spectral radius of M by power iteration with M + I, which does not swing; to about 1e-4.
  double radius() const { return radius_; }
  /// Whether the terms M^k shrink, stay as they are (a radius of 1 within 1e-9) or grow, in the long run.
  SeriesTerms terms() const;

 private:
  std::vector<double> times(const std::vector<double>& x) const;

  std::size_t size_ = 0;
  std::vector<std::vector<double>> powers_, sums_;  // from k = 0 on, as far as they were asked for
  double radius_ = 0;
};

}  // namespace unshot
