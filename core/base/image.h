// Pictures in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace unshot {

/// 8 bits per channel, sRGB-encoded; width * height * 3 values, row 0 is the top.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Linear values; width * height * 3 of them, row 0 is the top.
struct ImageF {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
};

}  // namespace unshot
