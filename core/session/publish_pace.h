// How often a running solve is published: at most once an interval, and so that making snapshots never takes
// more than a tenth of the solver's time, however large the mesh.
#pragma once

#include <algorithm>

namespace unshot {

class PublishPace {
 public:
  static constexpr double kLeastInterval = 1.0 / 30;  ///< [s]; the eye needs no more

  /// What is asked for, or kLeastInterval where that is longer (or the other is not a number).
  static double interval(double asked_seconds) {
    return asked_seconds > kLeastInterval ? asked_seconds : kLeastInterval;
  }

  /// A snapshot was made from `began` to `ended` [s of one clock].
  void made(double began, double ended) {
    last_ = ended;
    cost_ = std::max(ended - began, 0.0);
  }
  /// Whether the next one may be made at time `now`, with an interval [s] as `interval` gives it.
  bool due(double now, double interval_seconds) const {
    return now - last_ >= std::max(interval_seconds, 10 * cost_);
  }
  double cost() const { return cost_; }  ///< of the last snapshot [s]

 private:
  double last_ = -1e300, cost_ = 0;
};

}  // namespace unshot
