// The sRGB transfer curve (IEC 61966-2-1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace unshot {

/// Linear 0..1 from encoded 0..1.
inline double linearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Encoded 0..1 from linear; values outside 0..1 are clamped.
inline double srgbFromLinear(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

/// 0..255, rounded, from linear; values outside 0..1 are clamped.
inline std::uint8_t srgb8FromLinear(double linear) {
  return static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(linear)));
}

}  // namespace unshot
