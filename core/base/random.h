// Repeatable random numbers from counters.
#pragma once

#include <cstdint>

namespace unshot {

/// Mixes a counter into 64 well-spread bits (splitmix64, Steele, Lea and Flood 2014).
inline std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Uniform in [0, 1).
inline double unitInterval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// One number after the other, the same from the same start.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t start) : state_(start) {}
  double next() {
    state_ += 0x9e3779b97f4a7c15ull;
    return unitInterval(mixBits(state_));
  }

 private:
  std::uint64_t state_;
};

}  // namespace unshot
