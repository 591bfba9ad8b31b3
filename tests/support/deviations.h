// Whether random estimates and their standard errors agree with what they estimate.
#pragma once

#include <algorithm>
#include <cmath>

namespace unshot::testing_support {

/// Deviations in units of their standard errors: mean square near 1, none far out, if errors are honest.
struct Deviations {
  double square_sum = 0, worst = 0, sum = 0;
  int count = 0;

  void add(double estimate, double exact, double standard_error) {
    if (standard_error == 0 && estimate == exact) return;
    const double z = (estimate - exact) / standard_error;
    square_sum += z * z;
    sum += z;
    worst = std::max(worst, std::abs(z));
    ++count;
  }
  double meanSquare() const { return square_sum / count; }
  /// Of the mean, in units of what independent deviations give it.
  double bias() const { return sum / std::sqrt(static_cast<double>(count)); }
};

}  // namespace unshot::testing_support
