// False colours: a quantity as a scale of colours whose lightness rises all the way, so that it can be read
// without telling hues apart and in print.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace unshot {

/// How they are to be.
struct FalseColour {
  bool logarithmic = false;  ///< three decades, instead of from 0 on
  bool isolines = true;      ///< where the values of isolines() lie
  /// Luminous efficacy [lm/W] that the values are shown with, in lux; 0: none, in W/m^2.
  double lumens_per_watt = 0;
  bool operator==(const FalseColour&) const = default;
};

inline constexpr double kFalseColourDecades = 3;
inline constexpr std::size_t kMostIsolines = 16;

/// The scale's colours at equal steps from its low end to its top, linear RGB.
inline constexpr std::array<glm::vec3, 7> kFalseColourRamp = {{{0.004f, 0.002f, 0.020f},
                                                               {0.050f, 0.012f, 0.200f},
                                                               {0.055f, 0.085f, 0.420f},
                                                               {0.018f, 0.265f, 0.330f},
                                                               {0.085f, 0.500f, 0.130f},
                                                               {0.850f, 0.680f, 0.030f},
                                                               {1.000f, 0.960f, 0.720f}}};

/// Those of scales to both sides of 0, from it to the end above and to the one below.
inline constexpr std::size_t kDivergingColours = 4;
inline constexpr std::array<glm::vec3, 2 * kDivergingColours> kDivergingRamps = {{{0.03f, 0.03f, 0.03f},
                                                                                  {0.22f, 0.05f, 0.01f},
                                                                                  {0.95f, 0.30f, 0.02f},
                                                                                  {1.00f, 0.92f, 0.55f},
                                                                                  {0.03f, 0.03f, 0.03f},
                                                                                  {0.01f, 0.06f, 0.26f},
                                                                                  {0.04f, 0.30f, 1.00f},
                                                                                  {0.68f, 0.93f, 1.00f}}};

/// The same at `place` from -1 to 1, 0 in the middle.
glm::vec3 divergingColourAt(double place);

/// The colour at `place` on the scale, 0 its low end and 1 its top, linear RGB.
glm::vec3 falseColourAt(double place);

/// Where a value lies on the scale that ends at `top` > 0.
double falseColourPlace(double value, double top, bool logarithmic);

/// Values for isolines and the legend, ascending: round ones (1, 2 or 5 times a power of ten) in the unit
/// that is shown, in W/m^2, four to ten of them, the top perhaps among them.
std::vector<double> isolines(double top, const FalseColour& how);

}  // namespace unshot
