#include "render/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/colour.h"

namespace unshot {
namespace {

constexpr double kBright = 0.97;        // of the pixels are darker than what is shown near white
constexpr double kOnScale = 0.995;      // of the pixels lie within a scale
constexpr double kWhite = 0.9;          // what those are shown as
constexpr double kMiddleGrey = 0.2;     // what the logarithmic mean would be shown as
constexpr double kMostLift = 3;         // over the scale that shows the bright ones so
constexpr double kDarkest = 1e-3;       // of the bright ones: darker ones count as this
constexpr double kLargestScale = 1e36;  // stays a float, and so does its reciprocal

std::vector<double> luminances(std::span<const glm::vec4> pixels, float wanted) {
  std::vector<double> found;
  for (const glm::vec4& p : pixels) {
    if (p.w != wanted && !(wanted == kSurfacePixel && p.w == kNegativePixel)) continue;
    const double y = luminance(glm::dvec3(p));
    if (std::isfinite(y) && y > 0) found.push_back(y);
  }
  return found;
}

std::vector<double> reflecting(std::span<const glm::vec4> pixels) {
  std::vector<double> values = luminances(pixels, kSurfacePixel);
  return values.empty() ? luminances(pixels, kEmitterPixel) : values;
}

double quantile(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

double automaticExposure(std::span<const glm::vec4> pixels) {
  std::vector<double> values = reflecting(pixels);
  if (values.empty()) return 1;
  const double bright = quantile(values, kBright);
  double log_sum = 0;
  for (double y : values) log_sum += std::log(std::max(y, kDarkest * bright));
  const double log_mean = std::exp(log_sum / static_cast<double>(values.size()));
  const double scale_bright = kWhite / bright;
  const double scale_middle = kMiddleGrey / log_mean;
  const double lifted = std::sqrt(scale_bright) * std::sqrt(scale_middle);
  const double scale = std::clamp(lifted, scale_bright, kMostLift * scale_bright);
  return std::clamp(scale, 1 / kLargestScale, kLargestScale);
}

double scaleExposure(std::span<const glm::vec4> pixels) {
  std::vector<double> values = reflecting(pixels);
  if (values.empty()) return 1;
  return std::clamp(1 / quantile(values, kOnScale), 1 / kLargestScale, kLargestScale);
}

}  // namespace unshot
