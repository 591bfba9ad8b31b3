#include "render/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "render/exposure.h"

namespace unshot {
namespace {

glm::vec4 grey(float y, float kind = kSurfacePixel) { return {y, y, y, kind}; }

double sum(const std::array<double, LuminanceHistogram::kBins>& bins) {
  return std::accumulate(bins.begin(), bins.end(), 0.0);
}

TEST(Histogram, CountsEveryPixelOfSurfacesAndLampsOnce) {
  const std::vector<glm::vec4> pixels = {
      grey(0.02f),        grey(0.5f), grey(0.5f), grey(0), grey(30, kEmitterPixel), grey(7, kBackgroundPixel),
      grey(7, kEdgePixel)};
  const LuminanceHistogram h = luminanceHistogram(pixels);
  EXPECT_FALSE(h.empty);
  EXPECT_EQ(h.low_decade, -2);
  EXPECT_EQ(h.high_decade, 2);
  EXPECT_NEAR(sum(h.surfaces), 3.0 / 5, 1e-12);
  EXPECT_NEAR(sum(h.lamps), 1.0 / 5, 1e-12);
  EXPECT_NEAR(h.black, 1.0 / 5, 1e-12);
  const auto bin = static_cast<std::size_t>(h.placeOf(0.5) * LuminanceHistogram::kBins);
  EXPECT_NEAR(h.surfaces[bin], 2.0 / 5, 1e-12);
}

TEST(Histogram, SpansEightDecadesAtMost) {
  const LuminanceHistogram h = luminanceHistogram(std::vector{grey(1e-20f), grey(5)});
  EXPECT_EQ(h.high_decade - h.low_decade, 8);
  EXPECT_NEAR(h.black, 0.5, 1e-12);
}

TEST(Histogram, OfNothingIsEmpty) {
  EXPECT_TRUE(luminanceHistogram({}).empty);
  EXPECT_TRUE(luminanceHistogram(std::vector{grey(0), grey(std::numeric_limits<float>::quiet_NaN()),
                                             grey(std::numeric_limits<float>::infinity())})
                  .empty);
}

}  // namespace
}  // namespace unshot
