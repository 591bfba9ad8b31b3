#include "viewer/mip_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace unshot {
namespace {

/// How much of what lies side by side one pixel covers, of `from` pixels made `to`.
struct Covered {
  std::size_t first = 0;
  std::vector<float> shares;  // from `first` on; they add up to 1
};

std::vector<Covered> coverage(int from, int to) {
  std::vector<Covered> out;
  const double each = static_cast<double>(from) / to;
  for (int k = 0; k < to; ++k) {
    const double begin = k * each, end = begin + each;
    Covered covered{static_cast<std::size_t>(begin), {}};
    for (int i = static_cast<int>(begin); i < std::min(static_cast<int>(std::ceil(end - 1e-9)), from); ++i)
      covered.shares.push_back(
          static_cast<float>((std::min(end, i + 1.0) - std::max<double>(begin, i)) / each));
    out.push_back(std::move(covered));
  }
  return out;
}

ImageF halved(const ImageF& image, const CancelToken& cancel) {
  ImageF out{std::max(image.width / 2, 1), std::max(image.height / 2, 1), {}};
  const std::vector<Covered> columns = coverage(image.width, out.width),
                             rows = coverage(image.height, out.height);
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  out.rgb.reserve(3 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  std::vector<float> mean(row);
  for (const Covered& lines : rows) {
    cancel.check();
    std::fill(mean.begin(), mean.end(), 0.0f);
    for (std::size_t i = 0; i < lines.shares.size(); ++i) {
      const float* line = &image.rgb[(lines.first + i) * row];
      for (std::size_t k = 0; k < row; ++k) mean[k] += lines.shares[i] * line[k];
    }
    for (const Covered& pixels : columns) {
      for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0;
        for (std::size_t i = 0; i < pixels.shares.size(); ++i)
          sum += pixels.shares[i] * mean[3 * (pixels.first + i) + c];
        out.rgb.push_back(sum);
      }
    }
  }
  return out;
}

}  // namespace

std::vector<ImageF> mipLevels(ImageF image, const CancelToken& cancel) {
  std::vector<ImageF> levels;
  levels.push_back(std::move(image));
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back(), cancel));
  return levels;
}

}  // namespace unshot
