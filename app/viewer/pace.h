// How much of some work fits into a time, from how long it took before.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

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

/// What a picture costs as a rule. The first one of a kind takes a renderer some tenths of a second more, in
/// which it makes the code for it: one in a few does not count.
class PictureCosts {
 public:
  void note(double seconds) {
    if (std::exchange(first_, false)) return;
    last_[count_ % last_.size()] = seconds;
    ++count_;
  }
  /// The median of the last ones, without the very first; 0 while there is none.
  double usual() const {
    std::array<double, kLast> sorted = last_;
    const std::size_t known = std::min(count_, last_.size());
    if (known == 0) return 0;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(known));
    return sorted[(known - 1) / 2];
  }

 private:
  static constexpr std::size_t kLast = 5;
  std::array<double, kLast> last_{};
  std::size_t count_ = 0;
  bool first_ = true;
};

}  // namespace unshot
