#include "base/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/colour.h"
#include "base/srgb.h"
#include "gl/objects.h"
#include "render/exposure.h"
#include "render/scene_view.h"
#include "support/synthetic_room.h"

namespace unshot {
namespace {

TEST(ToneCurves, RiseFromBlackToWhite) {
  for (const ToneCurve& curve : toneCurves()) {
    SCOPED_TRACE(curve.info.key);
    EXPECT_EQ(curve.map(glm::dvec3(0.0)), glm::dvec3(0.0));
    EXPECT_EQ(curve.map(glm::dvec3(-1.0)), glm::dvec3(0.0));
    EXPECT_GT(curve.map(glm::dvec3(1e30)).x, 0.99);
    double before = 0;
    for (double x = 1e-4; x < 1e5; x *= 1.1) {
      const glm::dvec3 shown = curve.map(glm::dvec3(x));
      EXPECT_GE(shown.x, before - 1e-12) << x;
      EXPECT_LE(shown.x, 1) << x;
      EXPECT_LT(glm::length(shown - glm::dvec3(shown.x)), 1e-12) << "grey stays grey";
      before = shown.x;
    }
  }
}

TEST(ToneCurves, TheUsualOneLeavesWhatIsNotBrightAlone) {
  EXPECT_EQ(toneMap({0.5, 0.2, 0.1}), glm::dvec3(0.5, 0.2, 0.1));
  EXPECT_EQ(toneCurve(kUsualTone).map({2, 1, 0.5}), toneMap({2, 1, 0.5}));
  EXPECT_THROW(toneCurve("none"), Error);
}

/// What a pixel of 8 bits holds.
struct Shown {
  int width, height;
  std::vector<std::uint8_t> rgba;
};

Shown resolved(gl::Context& context, SceneView& view, const LinearTarget& samples, double exposure,
               const ViewOptions& options) {
  const gl::Functions& fn = context.functions();
  const gl::Texture texture(context);
  const gl::Framebuffer framebuffer(context);
  Shown out{samples.width(), samples.height(), {}};
  fn.BindTexture(GL_TEXTURE_2D, texture.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, out.width, out.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  view.resolve(samples, exposure, options, {0, 0, out.width, out.height});
  out.rgba.resize(4 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  fn.ReadPixels(0, 0, out.width, out.height, GL_RGBA, GL_UNSIGNED_BYTE, out.rgba.data());
  return out;
}

// The shader's curves are those of the table: each pixel as the table has it, to one step of 8 bits (single
// precision, and rounding at another place).
TEST(ToneCurves, ArePaintedAsTheTableSays) {
  const auto context = gl::createContext("osmesa");
  context->makeCurrent();
  const Snapshot room = testing_support::syntheticRoom();
  SceneView view(*context);
  view.setSnapshot(room);
  const LinearTarget samples(*context, 64, 48);
  for (const ToneCurve& curve : toneCurves()) {
    ViewOptions options;
    options.tone = curve.info.key;
    samples.bind();
    view.drawLinear({{0, 1, 3}, {0, 1, 0}, {0, 1, 0}, 40}, 4.0 / 3, {}, options);
    const std::vector<glm::vec4> linear = samples.read();
    for (const double exposure : {0.1, 1.0, 5.0}) {
      const Shown shown = resolved(*context, view, samples, exposure, options);
      int compared = 0, worst = 0;
      for (std::size_t k = 0; k < linear.size(); ++k) {
        if (linear[k].w == kBackgroundPixel) continue;
        ++compared;
        const glm::dvec3 wanted = curve.map(exposure * glm::dvec3(linear[k]));
        for (int c = 0; c < 3; ++c)
          worst =
              std::max(worst, std::abs(srgb8FromLinear(wanted[c]) - int{shown.rgba[4 * k + std::size_t(c)]}));
      }
      EXPECT_GT(compared, 1000);
      EXPECT_LE(worst, 1) << curve.info.key << " at exposure " << exposure;
    }
  }
}

}  // namespace
}  // namespace unshot
