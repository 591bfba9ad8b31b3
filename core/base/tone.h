// From exposed linear light to what a display shows, where about 1 is white: the table of tone curves, for
// colours made without GL, and each in GLSL.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "base/choice.h"

namespace unshot {

struct ToneCurve {
  ChoiceInfo info;
  /// Linear values of the display, 0..1, from linear values of any size.
  glm::dvec3 (*map)(const glm::dvec3& exposed);
  std::string_view shader;  ///< the same in GLSL, a file of shaders/
};

std::span<const ToneCurve> toneCurves();

inline constexpr std::string_view kUsualTone = "shoulder";

/// Throws a usage Error for an unknown key.
const ToneCurve& toneCurve(std::string_view key);

/// The usual curve: that of pictures.
glm::dvec3 toneMap(const glm::dvec3& exposed);

}  // namespace unshot
