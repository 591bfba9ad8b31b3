// Depth: surfaces a little apart are told from each other far away too, near things are not cut off, and
// contexts without reversed depth draw as before.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gl/context.h"
#include "mesh/build.h"
#include "render/picture.h"
#include "render/targets.h"
#include "scene/analytic_scenes.h"

namespace unshot {
namespace {

const glm::dvec3 kFloor(0.2), kSheet(0.8);

// A floor of 1000 x 1000 m, `height` above it a sheet as large, and far up a lamp that holds them lit.
Snapshot sheetOverFloor(double height) {
  SceneBuilder b;
  const auto floor = b.material("floor", kFloor), sheet = b.material("sheet", kSheet);
  const auto lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(1.0));
  b.quad(floor, {-500, 0, -500}, {0, 0, 1000}, {1000, 0, 0});
  b.quad(sheet, {-500, height, -500}, {0, 0, 1000}, {1000, 0, 0});
  b.quad(lamp, {-1, 200, -1}, {2, 0, 0}, {0, 0, 2});
  Snapshot snapshot;
  snapshot.mesh = std::make_shared<Mesh>(buildMesh(b.finish(), {.elements = 100, .element_size = {}}));
  return snapshot;
}

class Depth : public testing::TestWithParam<gl::Provider> {
 protected:
  void SetUp() override {
    context_ = gl::createContext(GetParam().info.key);
    context_->makeCurrent();
  }

  // Pixels that show another material than the sheet, in a picture taken from `eye` that holds only it.
  int strange(double height, const glm::dvec3& eye, const glm::dvec3& at) {
    PictureOptions options;
    options.width = 160;
    options.height = 120;
    options.display = "reflectance";
    options.eye = eye;
    options.at = at;
    const Picture drawn = renderPicture(*context_, sheetOverFloor(height), options);
    int found = 0;
    for (std::size_t i = 0; i < drawn.linear.rgb.size(); i += 3)
      found += std::abs(double{drawn.linear.rgb[i]} - kSheet.x) > 1e-3;
    return found;
  }

  std::unique_ptr<gl::Context> context_;
};

TEST_P(Depth, TellsSurfacesTwoCentimetresApartFromEachOtherHundredsOfMetresAway) {
  if (!context_->functions().ClipControl) return;  // 24 bits cannot
  EXPECT_EQ(strange(0.02, {0, 60, 450}, {0, 0, 360}), 0);
}

TEST_P(Depth, CutsNothingOffThatIsNear) {
  const double near = context_->functions().ClipControl ? 0.02 : 0.3;
  EXPECT_EQ(strange(1, {0, 1 + near, 0}, {0, 1, -0.01}), 0);
}

TEST_P(Depth, IsLeftAsOpenGlHasIt) {
  strange(1, {0, 3, 0}, {0, 1, -0.01});
  const gl::Functions& fn = context_->functions();
  GLint mode = 0;
  fn.GetIntegerv(GL_DEPTH_FUNC, &mode);
  EXPECT_EQ(mode, GL_LESS);
  if (fn.ClipControl) {
    fn.GetIntegerv(GL_CLIP_DEPTH_MODE, &mode);
    EXPECT_EQ(mode, GL_NEGATIVE_ONE_TO_ONE);
  }
}

TEST_P(Depth, IsReversedWhereTheContextPromisesIt) {
  const gl::Functions& fn = context_->functions();
  GLint major = 0, minor = 0;
  fn.GetIntegerv(GL_MAJOR_VERSION, &major);
  fn.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor >= 45) {
    EXPECT_NE(fn.ClipControl, nullptr);
  }
  EXPECT_EQ(DepthSetup(fn).range == DepthRange::kReversed, fn.ClipControl != nullptr);
  gl::Functions old = fn;
  old.ClipControl = nullptr;
  EXPECT_EQ(DepthSetup(old).range, DepthRange::kUsual);
  EXPECT_EQ(DepthSetup(old).format, GLenum{GL_DEPTH_COMPONENT24});
}

INSTANTIATE_TEST_SUITE_P(Render, Depth, testing::ValuesIn(gl::providers().begin(), gl::providers().end()),
                         [](const auto& row) { return std::string(row.param.info.key); });

TEST(ReversedDepth, FallsFromOneAtTheNearPlaneTowardsZero) {
  const Bounds bounds{glm::dvec3(-1), glm::dvec3(1)};
  const Camera camera{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  const glm::mat4 matrix = viewProjection(camera, 1, bounds, {}, DepthRange::kReversed);
  float last = 1;
  for (const float z : {1.0f, 0.5f, 0.0f, -1.0f}) {
    const glm::vec4 clip = matrix * glm::vec4(0.1f, 0.2f, z, 1.0f);
    EXPECT_NEAR(clip.w, 5 - z, 1e-6);
    EXPECT_LT(clip.z / clip.w, last);
    last = clip.z / clip.w;
  }
  EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace unshot
