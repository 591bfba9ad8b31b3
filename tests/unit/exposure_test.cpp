// How far a picture of high contrast is lifted.
#include "render/exposure.h"

#include <gtest/gtest.h>

#include <vector>

namespace unshot {
namespace {

// A tenth of the pixels is 1, the rest is `dark`.
double scaleFor(float dark) {
  std::vector<glm::vec4> pixels(90, glm::vec4(dark, dark, dark, kSurfacePixel));
  pixels.insert(pixels.end(), 10, glm::vec4(1, 1, 1, kSurfacePixel));
  return automaticExposure(pixels);
}

TEST(ExposureOfHighContrast, IsLiftedMoreTheDarkerMostOfItIs) {
  EXPECT_NEAR(scaleFor(0.8f), 0.9, 1e-6) << "the bright ones are near white";
  EXPECT_GT(scaleFor(0.05f), scaleFor(0.8f));
  EXPECT_GE(scaleFor(0.01f), scaleFor(0.05f));
}

// A lit doorway of a dim room keeps its colours.
TEST(ExposureOfHighContrast, IsNotLiftedWithoutEnd) {
  for (const float dark : {0.01f, 1e-3f, 1e-6f}) EXPECT_LE(scaleFor(dark), 3 * 0.9 + 1e-6) << dark;
}

}  // namespace
}  // namespace unshot
