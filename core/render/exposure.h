// Automatic exposure, from the picture itself.
//
// The scale is found from the luminances of the reflecting surfaces in view: background, black and the lamps
// themselves do not count (unless there is nothing else). The brightest of them come out near white; a
// picture of high contrast is lifted half of the way (in stops) towards showing its logarithmic mean as
// middle grey, but at most by a factor of 3: what is bright in a dim room keeps its colours.
#pragma once

#include <glm/vec4.hpp>
#include <span>

namespace unshot {

/// The classes of a pixel, in its alpha channel; the numbers are those of shaders/display.frag.
inline constexpr float kBackgroundPixel = 0;
inline constexpr float kSurfacePixel = 1;
inline constexpr float kEmitterPixel = 2;
inline constexpr float kEdgePixel = 3;
inline constexpr float kNegativePixel =
    4;  ///< a surface whose value is below 0; its size stands in the colour

/// The factor from linear values to the display's, where 1 is about white. `pixels`: linear RGB and class.
/// Finite and positive for any input: values of any scale, all black, infinite or NaN.
double automaticExposure(std::span<const glm::vec4> pixels);

/// The same for a scale of false colours, which ends at 1: where nearly all reflecting surfaces in view lie
/// below.
double scaleExposure(std::span<const glm::vec4> pixels);

}  // namespace unshot
