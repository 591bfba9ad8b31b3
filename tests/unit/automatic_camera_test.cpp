// The choice of a first view: what must lose, whatever the light, and from the first shot on.
#include "render/automatic_camera.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>

#include "base/colour.h"
#include "mesh/build.h"
#include "render/side_pictures.h"
#include "render/targets.h"
#include "render/view_judge.h"
#include "scene/analytic_scenes.h"

namespace unshot {
namespace {

constexpr int kWidth = 96, kHeight = 72;

// A thick block of ground with houses on it, all closed solids.
Scene town() {
  SceneBuilder b;
  const auto ground = b.material("ground", glm::dvec3(0.5)), house = b.material("house", glm::dvec3(0.7));
  addBox(b, allOf(ground), {0, 0, 0}, {40, 12, 40}, false);
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 5; ++k)
      addBox(b, allOf(house), {2 + 8 * i, 12, 2 + 8 * k}, {3, 2 + (i * k) % 3, 3}, false);
  }
  return b.finish();
}

// Irradiance by hand: one value per side.
Snapshot lit(const Scene& scene, const std::function<float(const Side&)>& irradiance) {
  Snapshot snapshot;
  snapshot.mesh = std::make_shared<Mesh>(buildMesh(scene, {.elements = 2000, .element_size = {}}));
  const Mesh& mesh = *snapshot.mesh;
  for (const std::uint32_t side : mesh.element_side)
    snapshot.element_irradiance.emplace_back(irradiance(mesh.sides[side]));
  snapshot.ambient.resize(mesh.vertices.size(), glm::vec3(0.0f));
  return snapshot;
}

class AutomaticCamera : public testing::Test {
 protected:
  void SetUp() override {
    context_ = gl::createContext("osmesa");
    context_->makeCurrent();
  }
  std::vector<std::uint32_t> look(const Mesh& mesh, const Camera& camera) {
    const StateGuard guard(context_->functions());
    return SidePictures(*context_, mesh, kWidth, kHeight).look(camera);
  }
  ViewFigures judged(const Snapshot& snapshot, const Camera& camera) {
    return judgeView(look(*snapshot.mesh, camera), kWidth, kHeight, camera, *snapshot.mesh,
                     sceneLight(snapshot));
  }
  std::unique_ptr<gl::Context> context_;
};

// Lamps that are closed solids light the inside of the ground more than the town.
TEST_F(AutomaticCamera, LooksAtATownAndNotIntoTheGroundWhateverIsLit) {
  for (const float inside : {0.0f, 1.0f, 1000.0f}) {
    const Snapshot snapshot = lit(town(), [&](const Side& side) { return side.back ? inside : 1.0f; });
    const ViewFigures view = judged(snapshot, automaticCamera(*context_, snapshot, {}));
    EXPECT_LT(view.backs, 0.3) << inside;
    EXPECT_LT(view.blocked, 0.5) << inside;
    EXPECT_GT(view.covered, 0.2) << inside;
  }
}

TEST_F(AutomaticCamera, CountsTheLightThatIsStillToCome) {
  Snapshot snapshot = lit(town(), [](const Side&) { return 0.0f; });
  EXPECT_EQ(sceneLight(snapshot).median, 0);
  std::fill(snapshot.ambient.begin(), snapshot.ambient.end(), glm::vec3(2.0f));
  const SceneLight light = sceneLight(snapshot);
  EXPECT_GT(light.median, 0.5 * 2 * 0.5);
  for (std::size_t e = 0; e < light.elements.size(); ++e) {
    const Side& side = snapshot.mesh->sides[snapshot.mesh->element_side[e]];
    EXPECT_NEAR(light.elements[e], luminance(2.0 * side.reflectance), 1e-5);
  }
}

TEST_F(AutomaticCamera, JudgesWhatIsSeenAndNotWhatIsHidden) {
  const Snapshot snapshot = lit(town(), [](const Side& side) { return side.back ? 0.0f : 1.0f; });
  const Bounds bounds{snapshot.mesh->bounds_min, snapshot.mesh->bounds_max};
  const ViewFigures above = judged(snapshot, frameBounds(bounds, {0.3, -1, -0.5}, {0, 1, 0}, 40, 4.0 / 3, 1));
  const ViewFigures below = judged(snapshot, frameBounds(bounds, {0.3, 1, -0.5}, {0, 1, 0}, 40, 4.0 / 3, 1));
  EXPECT_LT(above.backs, 0.15);
  EXPECT_GT(below.backs, 0.9);
  EXPECT_GT(above.lit, 0.7);
  EXPECT_LT(below.lit, 0.1);
}

// Each triangle stands for two sides; one that no light can reach is open, like a doll's house.
TEST_F(AutomaticCamera, SeesTheSideThatFacesIt) {
  const Snapshot snapshot = lit(furnaceScene(0.5, 1), [](const Side&) { return 1.0f; });
  const Mesh& mesh = *snapshot.mesh;
  const Camera outside =
      frameBounds({mesh.bounds_min, mesh.bounds_max}, {0, 0, -1}, {0, 1, 0}, 40, 4.0 / 3, 1);
  for (const Camera& camera : {outside, Camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 60}}) {
    std::size_t seen = 0;
    for (const std::uint32_t id : look(mesh, camera)) {
      if (id == 0) continue;
      ++seen;
      const Side& side = mesh.sides[id - 1];
      EXPECT_GT(glm::dot(camera.eye - mesh.surfaces[side.surface].origin, side.normal), 0);
    }
    EXPECT_GT(seen, kWidth * kHeight / 3u);
  }
}

}  // namespace
}  // namespace unshot
