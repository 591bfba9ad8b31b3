// Delta form factors of a hemicube: what share of a point's diffuse view each pixel fills.
//
// Cohen and Greenberg 1985 multiply the value at a pixel's centre by its area; here the cosine-weighted solid
// angle of the pixel's rectangle is exact (the difference of four corner terms of the closed form of a point
// and a rectangle), so the pixels sum to 1 to rounding at every resolution, and a picture of n pixels differs
// from the truth only by what lies within pixels.
#pragma once

#include <cstdint>
#include <vector>

namespace unshot {

/// The five faces of a hemicube in one picture `resolution` wide and 3 `resolution` high: rows [0, n) the top
/// face, then four side faces of n / 2 rows each, row 0 of each at the horizon.
struct HemicubeLayout {
  std::uint32_t resolution;  ///< n: pixels along an edge of the top face, even

  std::uint32_t width() const { return resolution; }
  std::uint32_t height() const { return 3 * resolution; }
  std::uint32_t faceRow(std::uint32_t face) const {
    return face == 0 ? 0 : resolution + (face - 1) * (resolution / 2);
  }
  std::uint32_t faceHeight(std::uint32_t face) const { return face == 0 ? resolution : resolution / 2; }
};

/// One value per pixel of the layout's picture, row by row. They sum to 1.
std::vector<double> deltaFormFactors(HemicubeLayout layout);

}  // namespace unshot
