// The colours follow cividis: J. R. Nunez, C. R. Anderton, R. S. Renslow, "Optimizing colormaps with
// consideration for color vision deficiency", PLoS ONE 13(7), 2018; every 32nd entry of the published table,
// interpolated linearly.
#include "report/difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace unshot {
namespace {

/// The value that `fraction` of the values do not exceed. Reorders `values`, which are not empty.
double quantile(std::vector<double>& values, double fraction) {
  const auto place = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = a - b;
  return std::sqrt(glm::dot(d, d) / 3);
}

glm::dvec3 pixelOf(const ImageF& image, std::size_t k) {
  return {image.rgb[3 * k], image.rgb[3 * k + 1], image.rgb[3 * k + 2]};
}

}  // namespace

Difference differenceOf(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  Difference result;
  result.points = a.size();
  if (a.empty()) return result;
  double square = 0, reference_square = 0;
  std::vector<double> distances(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    const glm::dvec3 d = a[k] - b[k];
    square += glm::dot(d, d);
    reference_square += glm::dot(b[k], b[k]);
    for (int c = 0; c < 3; ++c) {
      result.bias += d[c];
      result.reference_mean += b[k][c];
      result.mean += std::abs(d[c]);
      result.max = std::max(result.max, std::abs(d[c]));
    }
    distances[k] = distance(a[k], b[k]);
  }
  const double count = 3 * static_cast<double>(a.size());
  result.rms = std::sqrt(square / count);
  result.reference_rms = std::sqrt(reference_square / count);
  result.mean /= count;
  result.bias /= count;
  result.reference_mean /= count;
  if (result.rms > 0) {
    result.nrmse = result.reference_rms > 0 ? result.rms / result.reference_rms
                                            : std::numeric_limits<double>::infinity();
  }
  result.median = quantile(distances, 0.5);
  result.worst_5 = quantile(distances, 0.95);
  return result;
}

glm::dvec3 heatColour(double t) {
  static constexpr std::array<std::array<double, 3>, 9> kColours = {{{0.000, 0.135, 0.304},
                                                                     {0.101, 0.220, 0.431},
                                                                     {0.259, 0.305, 0.424},
                                                                     {0.374, 0.390, 0.432},
                                                                     {0.488, 0.480, 0.470},
                                                                     {0.604, 0.573, 0.467},
                                                                     {0.733, 0.677, 0.430},
                                                                     {0.866, 0.786, 0.360},
                                                                     {0.996, 0.909, 0.218}}};
  const double x = std::clamp(t, 0.0, 1.0) * (kColours.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(x), kColours.size() - 2);
  const auto colour = [&](std::size_t k) {
    return glm::dvec3(kColours[k][0], kColours[k][1], kColours[k][2]);
  };
  return glm::mix(colour(low), colour(low + 1), x - static_cast<double>(low));
}

HeatMap heatMapOf(const ImageF& a, const ImageF& b) {
  HeatMap map;
  map.image.width = a.width;
  map.image.height = a.height;
  map.image.rgb.resize(a.rgb.size());
  std::vector<double> distances(a.rgb.size() / 3);
  for (std::size_t k = 0; k < distances.size(); ++k) distances[k] = distance(pixelOf(a, k), pixelOf(b, k));
  if (distances.empty()) return map;
  std::vector<double> sorted = distances;
  map.top = quantile(sorted, 0.99);
  if (!(map.top > 0)) map.top = *std::max_element(distances.begin(), distances.end());
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const glm::dvec3 colour = heatColour(map.top > 0 ? distances[k] / map.top : 0);
    for (int c = 0; c < 3; ++c) {
      map.image.rgb[3 * k + static_cast<std::size_t>(c)] =
          static_cast<std::uint8_t>(std::lround(255 * colour[c]));
    }
  }
  return map;
}

}  // namespace unshot
