// Figures of the difference between two sets of values, and its picture.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "base/image.h"

namespace unshot {

/// A against the reference B, over points and channels, each with the same weight. In the unit of the values
/// where nothing else is said.
struct Difference {
  std::size_t points = 0;
  double nrmse = 0;           ///< RMS(A - B) / RMS(B); 0 where both are 0, infinite where only B is
  double rms = 0;             ///< RMS(A - B)
  double reference_rms = 0;   ///< RMS(B)
  double mean = 0;            ///< mean |A - B|
  double max = 0;             ///< max |A - B|
  double bias = 0;            ///< mean(A - B)
  double reference_mean = 0;  ///< mean(B)
  double median = 0;          ///< median over points of |A - B|
  double worst_5 = 0;         ///< |A - B| that 5 % of the points exceed
};

/// |A - B| of a point is the RMS over its channels in `median` and `worst_5`. Same sizes.
Difference differenceOf(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b);

/// A heat map of |A - B| (RMS over channels) with its scale.
struct HeatMap {
  Image8 image;
  double top =
      0;  ///< the value that has the brightest colour, in the unit of the values; larger ones have it too
};

/// Colours run from dark blue (0) over grey to yellow (`top`), rising in lightness all the way, so that they
/// read the same with any colour vision. `top` is the value that 1 % of the pixels exceed (the maximum where
/// that is 0). Pictures of the same size.
HeatMap heatMapOf(const ImageF& a, const ImageF& b);

/// Colour of the heat map, sRGB; t from 0 to 1.
glm::dvec3 heatColour(double t);

}  // namespace unshot
