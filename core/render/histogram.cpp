#include "render/histogram.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "render/exposure.h"

namespace unshot {
namespace {

constexpr double kMostDecades = 8;

}  // namespace

double LuminanceHistogram::placeOf(double luminance) const {
  return (std::log10(luminance) - low_decade) / (high_decade - low_decade);
}

LuminanceHistogram luminanceHistogram(std::span<const glm::vec4> pixels) {
  LuminanceHistogram out;
  std::vector<std::pair<double, bool>> logs;  // and whether it is a lamp
  std::size_t counted = 0;
  for (const glm::vec4& p : pixels) {
    if (p.w != kSurfacePixel && p.w != kEmitterPixel) continue;
    ++counted;
    const double y = luminance(glm::dvec3(p));
    if (y > 0 && std::isfinite(y)) logs.emplace_back(std::log10(y), p.w == kEmitterPixel);
  }
  if (logs.empty()) return out;
  const auto [darkest, brightest] = std::minmax_element(logs.begin(), logs.end());
  out.empty = false;
  out.high_decade = std::floor(brightest->first) + 1;
  out.low_decade = std::max(std::floor(darkest->first), out.high_decade - kMostDecades);
  const double share = 1 / static_cast<double>(counted);
  std::size_t in_bins = 0;
  for (const auto& [log, lamp] : logs) {
    const double place = (log - out.low_decade) / (out.high_decade - out.low_decade);
    if (place < 0) continue;
    const auto bin =
        std::min(static_cast<std::size_t>(place * LuminanceHistogram::kBins), LuminanceHistogram::kBins - 1);
    (lamp ? out.lamps : out.surfaces)[bin] += share;
    ++in_bins;
  }
  out.black = share * static_cast<double>(counted - in_bins);
  return out;
}

}  // namespace unshot
