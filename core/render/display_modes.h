// What a picture shows. A mode is a row; one that shows a new quantity adds its case to shaders/display.vert,
// or to display_by_pixel.frag where it cannot be worked out at vertices.
#pragma once

#include <span>
#include <string_view>

#include "base/choice.h"

namespace unshot {

/// What is drawn; the numbers are those of these shaders.
enum class Quantity {
  kRadiosity = 0,
  kIrradiance = 1,
  kUnshot = 2,
  kEmission = 3,
  kReflectance = 4,
  kBounces = 5,
  kResidual = 6,
  kDifference = 7,
  kPatches = 8,
  kSides = 9,
  kNormals = 10,
  kFormFactors = 11,
  kLastShot = 12
};

struct DisplayMode {
  ChoiceInfo info;
  Quantity quantity = Quantity::kRadiosity;
  bool per_element = false;   ///< the element's own value all over it, instead of interpolated
  bool edges = false;         ///< element edges drawn over it
  bool tone_mapped = true;    ///< exposed automatically and tone-mapped; else 1 is white
  bool exposed = true;        ///< ViewOptions::exposure_ev applies
  bool false_colour = false;  ///< its luminance as a scale of colours; the exposure says where that ends
  bool diverging = false;     ///< of false colours: to both sides of 0
};

std::span<const DisplayMode> displayModes();

/// Throws a usage Error for an unknown key.
const DisplayMode& displayMode(std::string_view key);

}  // namespace unshot
