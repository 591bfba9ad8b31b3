// The scale of false colours: lightness that rises, round values.
#include "render/false_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "render/exposure.h"

namespace unshot {
namespace {

double lightness(const glm::vec3& c) {
  const double y = luminance(glm::dvec3(c));
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;  // CIE L*, 0 to 100
}

TEST(FalseColour, LightnessRisesAllTheWay) {
  double before = lightness(falseColourAt(0));
  EXPECT_LT(before, 5);
  for (int k = 1; k <= 60; ++k) {
    const double now = lightness(falseColourAt(k / 60.0));
    EXPECT_GT(now - before, 0.7) << "at " << k / 60.0;
    EXPECT_LT(now - before, 4) << "at " << k / 60.0;
    before = now;
  }
  EXPECT_GT(before, 95);
  EXPECT_EQ(falseColourAt(-1), falseColourAt(0));
  EXPECT_EQ(falseColourAt(2), falseColourAt(1));
}

TEST(FalseColour, BothWaysFromZeroLightnessRises) {
  for (const double way : {1.0, -1.0}) {
    double before = lightness(divergingColourAt(0));
    for (int k = 1; k <= 30; ++k) {
      const double now = lightness(divergingColourAt(way * k / 30));
      EXPECT_GT(now, before) << way * k / 30;
      before = now;
    }
    const glm::vec3 half = divergingColourAt(way / 2);
    EXPECT_EQ(half.x > half.z, way > 0) << "orange above, blue below";
    EXPECT_EQ(divergingColourAt(3 * way), divergingColourAt(way));
  }
}

TEST(FalseColour, PlacesLieWhereTheScaleHasThem) {
  EXPECT_DOUBLE_EQ(falseColourPlace(3, 12, false), 0.25);
  EXPECT_DOUBLE_EQ(falseColourPlace(12, 12, true), 1);
  EXPECT_DOUBLE_EQ(falseColourPlace(1.2, 12, true), 1 - 1 / kFalseColourDecades);
  EXPECT_EQ(falseColourPlace(0, 12, true), 0);
  EXPECT_EQ(falseColourPlace(-1, 12, false), 0);
  EXPECT_EQ(falseColourPlace(100, 12, false), 1);
}

bool isRound(double value) {
  const double digits = value / std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  return std::abs(10 * digits - std::round(10 * digits)) < 1e-6;
}

TEST(FalseColour, IsolinesAreRoundInTheUnitShown) {
  for (const bool logarithmic : {false, true}) {
    for (const double efficacy : {0.0, 683.0}) {
      for (const double top : {1e-30, 1e-4, 0.37, 1.0, 1.99, 2.0, 4.99, 5.0, 9.999, 10.0, 312.0, 1e30}) {
        const FalseColour how{logarithmic, true, efficacy};
        const std::vector<double> values = isolines(top, how);
        ASSERT_GE(values.size(), 4u) << top;
        ASSERT_LE(values.size(), 10u) << top;
        for (std::size_t k = 0; k < values.size(); ++k) {
          const double shown = values[k] * (efficacy > 0 ? efficacy : 1);
          EXPECT_TRUE(isRound(shown)) << shown;
          EXPECT_LE(values[k], top * (1 + 1e-8));
          EXPECT_GT(values[k], k > 0 ? values[k - 1] : 0);
        }
      }
    }
  }
  EXPECT_TRUE(isolines(0, {}).empty());
  EXPECT_TRUE(isolines(std::nan(""), {}).empty());
  EXPECT_TRUE(isolines(INFINITY, {}).empty());
}

TEST(FalseColour, TheScaleHoldsNearlyAllThatReflects) {
  std::vector<glm::vec4> pixels(1000, glm::vec4(1, 1, 1, kSurfacePixel));
  for (std::size_t k = 0; k < 4; ++k) pixels[k] = glm::vec4(50, 50, 50, kSurfacePixel);  // a glint
  pixels.resize(1500, glm::vec4(900, 900, 900, kEmitterPixel));
  EXPECT_NEAR(scaleExposure(pixels), 1, 1e-6);
  EXPECT_EQ(scaleExposure({}), 1);
  // Values below 0 count by their size.
  for (glm::vec4& pixel : pixels) {
    if (pixel.w == kSurfacePixel) pixel.w = kNegativePixel;
  }
  EXPECT_NEAR(scaleExposure(pixels), 1, 1e-6);
}

}  // namespace
}  // namespace unshot
