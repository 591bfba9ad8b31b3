// How much of some work fits into a time, from how long it took before.
#pragma once

#include <algorithm>
#include <cstddef>

namespace unshot {

class Pace {
 public:
  /// A time may be exceeded by this factor where that saves another one.
  static constexpr double kOverrun = 1.5;

  /// Of `rest` units, how many to do in about `seconds`: at least `least`, and all where little would be left
  /// for another time.
  std::size_t next(double seconds, std::size_t rest, std::size_t least) const {
    const double fit = std::max(seconds * rate_, static_cast<double>(least));
    return static_cast<double>(rest) <= kOverrun * fit ? rest : static_cast<std::size_t>(fit);
  }
  /// How long this many will take [s]; infinite while nothing is known.
  double seconds(std::size_t units) const { return units == 0 ? 0 : static_cast<double>(units) / rate_; }
  void note(std::size_t units, double seconds) {
    const double rate = static_cast<double>(units) / std::max(seconds, 1e-9);
    rate_ = rate_ == 0 ? rate : (rate_ + rate) / 2;
  }

 private:
  double rate_ = 0;  // units a second
};

}  // namespace unshot
