// How often which luminance is in view.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <span>

namespace unshot {

struct LuminanceHistogram {
  static constexpr std::size_t kBins = 80;
  double low_decade = 0, high_decade = 1;  ///< log10 of where the first bin begins and the last one ends
  std::array<double, kBins> surfaces{};    ///< shares of all pixels counted, by equal steps of the logarithm
  std::array<double, kBins> lamps{};       ///< the same of pixels that show emitters
  double black = 0;                        ///< share of pixels that are black
  bool empty = true;                       ///< nothing but black

  /// Where a luminance lies, 0 the left end and 1 the right one; may be beyond.
  double placeOf(double luminance) const;
};

/// `pixels`: linear RGB and class (exposure.h), of which background and edges do not count. It spans whole
/// decades, at most the eight below the brightest pixel; what is darker counts as black.
LuminanceHistogram luminanceHistogram(std::span<const glm::vec4> pixels);

}  // namespace unshot
