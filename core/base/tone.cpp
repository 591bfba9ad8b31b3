// Sources: E. Reinhard et al., "Photographic tone reproduction for digital images", SIGGRAPH 2002, equation
// 4; K. Narkowicz, "ACES filmic tone mapping curve", 2015 (a fit of the reference rendering transform).
#include "base/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "base/colour.h"

namespace unshot {
namespace {

constexpr double kLargest = 1e4;

glm::dvec3 limited(const glm::dvec3& exposed) { return glm::clamp(exposed, 0.0, kLargest); }

// The shoulder acts on the largest channel, so that the hue stays; far above the knee it acts on each
// channel, so that lamps go to white.
glm::dvec3 softShoulder(const glm::dvec3& exposed) {
  constexpr double kKnee = 0.6;
  const auto shoulder = [](double x) {
    const double over = x - kKnee;
    return over > 0 ? kKnee + (1 - kKnee) * over / (over + (1 - kKnee)) : x;
  };
  const glm::dvec3 c = limited(exposed);
  const double largest = std::max({c.x, c.y, c.z});
  if (largest <= kKnee) return c;
  const glm::dvec3 same_hue = c * (shoulder(largest) / largest);
  const glm::dvec3 each(shoulder(c.x), shoulder(c.y), shoulder(c.z));
  return glm::mix(same_hue, each, glm::smoothstep(0.0, 1.0, 1 - kKnee / largest));
}

glm::dvec3 cutAtWhite(const glm::dvec3& exposed) { return glm::min(limited(exposed), glm::dvec3(1.0)); }

// Twice as bright as without a curve in the darks; four times white and more is white.
glm::dvec3 photographic(const glm::dvec3& exposed) {
  const glm::dvec3 c = 2.0 * limited(exposed);
  const double y = luminance(c);
  return glm::min(c * ((1 + y / 64) / (1 + y)), glm::dvec3(1.0));
}

glm::dvec3 filmic(const glm::dvec3& exposed) {
  const glm::dvec3 c = limited(exposed);
  const auto each = [](double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); };
  return glm::clamp(glm::dvec3(each(c.x), each(c.y), each(c.z)), 0.0, 1.0);
}

// Lightness, about the power 1 / 2.2 of linear values, runs with the logarithm.
glm::dvec3 logarithmic(const glm::dvec3& exposed) {
  const glm::dvec3 c = limited(exposed);
  const double y = luminance(c);
  if (y <= 0) return glm::dvec3(0.0);
  const double place = std::clamp(1 + std::log10(y) / 3, 0.0, 1.0);
  return glm::min(c * (std::pow(place, 2.2) / y), glm::dvec3(1.0));
}

}  // namespace

std::span<const ToneCurve> toneCurves() {
  static constexpr std::array<ToneCurve, 5> table = {{
      {{kUsualTone, "Soft shoulder", "as it is up to 0.6 of white, above it a shoulder that keeps the hue"},
       softShoulder,
       "tone_shoulder.frag"},
      {{"clamp", "Linear, cut at white", "as it is; what is brighter than white is white"},
       cutAtWhite,
       "tone_clamp.frag"},
      {{"photographic", "Photographic",
        "after Reinhard: darks twice as bright, ever less from there to four times white"},
       photographic,
       "tone_photographic.frag"},
      {{"filmic", "Filmic", "the curve of film, with a toe and a shoulder: more contrast (ACES)"},
       filmic,
       "tone_filmic.frag"},
      {{"logarithmic", "Logarithmic", "three decades below white, in equal steps: what is in the dark"},
       logarithmic,
       "tone_logarithmic.frag"},
  }};
  return table;
}

const ToneCurve& toneCurve(std::string_view key) { return findChoice(toneCurves(), key, "tone curve"); }

glm::dvec3 toneMap(const glm::dvec3& exposed) { return softShoulder(exposed); }

}  // namespace unshot
