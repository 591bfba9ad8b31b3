// The picture without indirect light.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/colour.h"
#include "gl/context.h"
#include "render/exposure.h"
#include "render/scene_view.h"
#include "support/synthetic_room.h"

namespace unshot {
namespace {

using testing_support::syntheticRoom;

std::shared_ptr<const std::vector<glm::vec3>> constant(std::size_t count, const glm::vec3& value) {
  return std::make_shared<const std::vector<glm::vec3>>(count, value);
}

class DirectLight : public testing::TestWithParam<gl::Provider> {
 protected:
  void SetUp() override {
    context_ = gl::createContext(GetParam().info.key);
    context_->makeCurrent();
    std::fill(room_.irradiance.begin(), room_.irradiance.end(), glm::vec3(2, 3, 4));
    std::fill(room_.element_irradiance.begin(), room_.element_irradiance.end(), glm::vec3(1, 2, 3));
    std::fill(room_.ambient.begin(), room_.ambient.end(), glm::vec3(0.5f));
  }
  // The value in the middle of a picture of the back wall, whose reflectance is 0.75.
  glm::dvec3 shown(SceneView& view, const std::string& display, bool indirect, bool ambient) {
    ViewOptions options;
    options.display = display;
    options.light.indirect = indirect;
    options.ambient = ambient;
    return shown(view, options);
  }
  glm::dvec3 shown(SceneView& view, const ViewOptions& options) {
    const LinearTarget target(*context_, 32, 24);
    target.bind();
    view.drawLinear({{-0.5, 1, 3}, {-0.5, 1, 0}, {0, 1, 0}, 40}, 4.0 / 3, {}, options, false);
    EXPECT_EQ(context_->functions().GetError(), GLenum{GL_NO_ERROR});
    const glm::vec4 pixel = target.read()[12 * 32 + 16];
    class_ = pixel.w;
    return glm::dvec3(glm::vec3(pixel));
  }
  static void expectNear(const glm::dvec3& got, const glm::dvec3& expected, const std::string& what) {
    EXPECT_LT(glm::length(got - expected), 1e-5) << what << ": " << got.x << " " << got.y << " " << got.z;
  }

  std::unique_ptr<gl::Context> context_;
  Snapshot room_ = syntheticRoom();
  float class_ = 0;  // of the pixel that was looked at last
};

TEST_P(DirectLight, IsShownAloneWithoutASnapshotMore) {
  room_.direct = constant(room_.irradiance.size(), {1.5f, 1, 0.5f});
  room_.element_direct = constant(room_.element_irradiance.size(), {0.75f, 0.5f, 0.25f});
  SceneView view(*context_);
  view.setSnapshot(room_);
  const glm::dvec3 direct(1.5, 1, 0.5);
  for (int round = 0; round < 2; ++round) {
    for (const bool ambient : {false, true}) {  // of which direct light has nothing
      expectNear(shown(view, "radiosity", false, ambient), 0.75 * direct, "radiosity");
      expectNear(shown(view, "mesh", false, ambient), 0.75 * direct, "mesh");
      expectNear(shown(view, "irradiance", false, ambient), direct, "irradiance");
      expectNear(shown(view, "flat", false, ambient), 0.375 * direct, "flat");
    }
    expectNear(shown(view, "radiosity", true, false), 0.75 * glm::dvec3(2, 3, 4), "all light");
    expectNear(shown(view, "radiosity", true, true), 0.75 * glm::dvec3(2.5, 3.5, 4.5), "with ambient");
    expectNear(shown(view, "flat", true, false), 0.75 * glm::dvec3(1, 2, 3), "flat, all light");
  }
}

TEST_P(DirectLight, FollowsTheSnapshotAndIsDarkWhereThereIsNone) {
  SceneView view(*context_);
  view.setSnapshot(room_);
  expectNear(shown(view, "radiosity", false, true), glm::dvec3(0.0), "none");
  expectNear(shown(view, "flat", false, true), glm::dvec3(0.0), "none per element");
  for (const float light : {1.0f, 2.0f}) {
    room_.direct = constant(room_.irradiance.size(), glm::vec3(light));
    room_.element_direct = constant(room_.element_irradiance.size(), glm::vec3(light));
    view.setSnapshot(room_);
    expectNear(shown(view, "irradiance", false, true), glm::dvec3(light), "as given");
    expectNear(shown(view, "flat", false, true), 0.75 * glm::dvec3(light), "as given per element");
  }
  room_.direct = nullptr;
  room_.element_direct = nullptr;
  view.setSnapshot(room_);
  expectNear(shown(view, "irradiance", false, true), glm::dvec3(0.0), "gone");
}

TEST_P(DirectLight, BouncesAreShownAsFarAsTheyAreKnown) {
  const auto field = [&](float light) {
    return std::make_shared<const MeshField>(
        MeshField{std::vector<glm::vec3>(room_.irradiance.size(), glm::vec3(light)),
                  std::vector<glm::vec3>(room_.element_irradiance.size(), glm::vec3(light / 2))});
  };
  SceneView view(*context_);
  ViewOptions options;
  options.light.bounces = 2;
  view.setSnapshot(room_);
  options.ambient = false;
  expectNear(shown(view, options), 0.75 * glm::dvec3(2, 3, 4), "none known: all light");
  options.ambient = true;
  room_.bounce_light = std::make_shared<const BounceLight>(BounceLight{{}, {field(4), field(6), field(7)}});
  view.setSnapshot(room_);
  for (int round = 0; round < 2; ++round) {
    options.display = "radiosity";
    options.light.bounces = 1;
    expectNear(shown(view, options), glm::dvec3(0.75 * 4), "one");
    options.light.bounces = 2;
    expectNear(shown(view, options), glm::dvec3(0.75 * 6), "two");
    options.display = "flat";
    expectNear(shown(view, options), glm::dvec3(0.75 * 3), "two, flat");
    options.light.bounces = 9;
    expectNear(shown(view, options), glm::dvec3(0.75 * 3.5), "more than are known");
  }
}

TEST_P(DirectLight, ABounceAloneIsWhatItAddsWithoutTheLightEmitted) {
  const auto field = [&](float light) {
    return std::make_shared<const MeshField>(
        MeshField{std::vector<glm::vec3>(room_.irradiance.size(), glm::vec3(light)),
                  std::vector<glm::vec3>(room_.element_irradiance.size(), glm::vec3(light / 2))});
  };
  room_.bounce_light = std::make_shared<const BounceLight>(BounceLight{{}, {field(4), field(6), field(7)}});
  auto lamp = std::make_shared<Mesh>(*room_.mesh);
  for (Side& side : lamp->sides) side.emission = glm::dvec3(10);
  SceneView view(*context_);
  ViewOptions options;
  options.light.alone = true;
  for (const bool lamps : {false, true}) {
    if (lamps) room_.mesh = lamp;
    view.setSnapshot(room_);
    options.display = "radiosity";
    options.light.bounces = 1;
    expectNear(shown(view, options), glm::dvec3(0.75 * 4), "the first");
    options.light.bounces = 2;
    expectNear(shown(view, options), glm::dvec3(0.75 * 2), "the second");
    options.light.bounces = 3;
    expectNear(shown(view, options), glm::dvec3(0.75 * 1), "the third");
    options.light.alone = false;
    expectNear(shown(view, options), glm::dvec3(0.75 * 7 + (lamps ? 10 : 0)), "up to the third");
    options.light.alone = true;
    options.display = "flat";
    expectNear(shown(view, options), glm::dvec3(0.75 * 0.5), "the third, flat");
    options.display = "emission";
    expectNear(shown(view, options), glm::dvec3(lamps ? 10 : 0), "what is emitted stays what it is");
  }
  const ReferenceLight third = referenceLight(room_, options.light, "the third");
  EXPECT_FLOAT_EQ(third.reflected[0].x, 0.75f);
}

TEST_P(DirectLight, DifferencesHaveTheSignAndSizeOfTheirColour) {
  room_.direct = constant(room_.irradiance.size(), {2, 3, 4});
  SceneView view(*context_);
  view.setSnapshot(room_);
  ViewOptions options;
  options.display = "difference";
  expectNear(shown(view, options), glm::dvec3(0.0), "as direct light, whatever the ambient term");
  for (const double factor : {0.5, 0.98, 1.0, 1.004, 1.3, 3.0}) {
    // The reference reflects as much everywhere as is reflected now, over `factor`.
    const std::vector<glm::dvec3> radiosity(room_.irradiance.size(), 0.75 * glm::dvec3(2, 3, 4) / factor);
    auto reference = std::make_shared<ReferenceLight>(referenceLight(room_.mesh, radiosity, "test"));
    EXPECT_NEAR(reference->mean, luminance(radiosity[0]), 1e-5);
    options.reference = reference;
    EXPECT_LT(glm::length(shown(view, options) - glm::dvec3(std::abs(factor - 1))), 2e-3) << factor;
    EXPECT_EQ(class_, factor < 0.999 ? kNegativePixel : kSurfacePixel) << factor;
  }
}

// The scale of differences ends where nearly all in view do, and not in what rounding makes of equal light.
TEST_P(DirectLight, TheScaleOfDifferencesEndsWhereTheyDo) {
  room_.direct = constant(room_.irradiance.size(), {2, 3, 4});
  SceneView view(*context_);
  view.setSnapshot(room_);
  ViewOptions options;
  options.display = "difference";
  for (const double factor : {0.25, 1.0, 1.0 + 1e-7, 1.5, 5.0}) {
    std::vector<glm::dvec3> radiosity;
    for (const Vertex& vertex : room_.mesh->vertices) {
      const Side& side = room_.mesh->sides[vertex.side];
      radiosity.push_back(side.emission + side.reflectance * glm::dvec3(2, 3, 4) / factor);
    }
    options.reference = std::make_shared<ReferenceLight>(referenceLight(room_.mesh, radiosity, "test"));
    const double scale = view.exposureFor({{-0.5, 1, 3}, {-0.5, 1, 0}, {0, 1, 0}, 40}, 4.0 / 3, options);
    const double most = std::abs(factor - 1);
    if (most < 1e-5) {
      EXPECT_GE(1 / scale, 0.01) << factor;
    } else {
      EXPECT_GT(1 / scale, 0.3 * most) << factor;
      EXPECT_LT(1 / scale, 3 * most) << factor;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Providers, DirectLight,
                         testing::ValuesIn(gl::providers().begin(), gl::providers().end()),
                         [](const auto& row) { return std::string(row.param.info.key); });

}  // namespace
}  // namespace unshot
