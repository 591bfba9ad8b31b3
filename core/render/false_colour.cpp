#include "render/false_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace unshot {

glm::vec3 falseColourAt(double place) {
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(kFalseColourRamp.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), kFalseColourRamp.size() - 2);
  return glm::mix(kFalseColourRamp[below], kFalseColourRamp[below + 1],
                  static_cast<float>(at - static_cast<double>(below)));
}

glm::vec3 divergingColourAt(double place) {
  constexpr std::size_t kSteps = kDivergingColours - 1;
  const double at = std::min(std::abs(place), 1.0) * static_cast<double>(kSteps);
  const std::size_t step = std::min(static_cast<std::size_t>(at), kSteps - 1);
  const std::size_t below = step + (place < 0 ? kDivergingColours : 0);
  return glm::mix(kDivergingRamps[below], kDivergingRamps[below + 1],
                  static_cast<float>(at - static_cast<double>(step)));
}

double falseColourPlace(double value, double top, bool logarithmic) {
  const double share = value / top;
  if (!logarithmic) return std::clamp(share, 0.0, 1.0);
  return share > 0 ? std::clamp(1 + std::log10(share) / kFalseColourDecades, 0.0, 1.0) : 0;
}

std::vector<double> isolines(double top, const FalseColour& how) {
  std::vector<double> out;
  const double unit = how.lumens_per_watt > 0 ? how.lumens_per_watt : 1;
  const double shown = unit * top;
  if (!(shown > 0) || !std::isfinite(shown)) return out;
  if (how.logarithmic) {
    const double low = shown / std::pow(10.0, kFalseColourDecades);
    for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= shown; decade *= 10) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit * decade > low && digit * decade <= shown) out.push_back(digit * decade / unit);
      }
    }
    return out;
  }
  const double decade = std::pow(10.0, std::floor(std::log10(shown)));
  const double digits = shown / decade;  // 1 to 10
  const double step = decade * (digits < 2 ? 0.2 : digits < 5 ? 0.5 : 1);
  for (int k = 1; k * step <= shown * (1 + 1e-9); ++k) out.push_back(k * step / unit);
  return out;
}

}  // namespace unshot
