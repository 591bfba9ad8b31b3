#include "session/coarse_mesh.h"

#include <gtest/gtest.h>

#include <vector>

#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

std::shared_ptr<const Mesh> meshOf(const Scene& scene, double elements) {
  return std::make_shared<const Mesh>(buildMesh(scene, {.elements = static_cast<std::uint64_t>(elements),
                                                        .element_size = {},
                                                        .emit_front_only = true,
                                                        .paired_cells = true}));
}

// Notes what is tried.
struct Trials {
  Scene scene;
  std::vector<double> tried{};

  CoarseMesh find(double error) {
    return findCoarseMesh(*meshOf(scene, 1),
                          {.error = error,
                           .usual = 2500,
                           .make =
                               [&](double elements) {
                                 tried.push_back(elements);
                                 return meshOf(scene, elements);
                               }},
                          {});
  }
};

TEST(CoarseMesh, IsTheFirstTriedWhereLightIsEven) {
  Trials trials{furnaceScene(0.5, 0.5)};
  const CoarseMesh found = trials.find(0.01);
  ASSERT_TRUE(found.mesh);
  EXPECT_EQ(trials.tried.size(), 1u);
  EXPECT_LT(found.mesh->element_count, 60u);
  EXPECT_LT(found.solved.error.high, 1e-4);
}

// In a room with one bright wall errors fall slowly: what would be needed is known from the first trials,
// which are the only ones.
TEST(CoarseMesh, IsGivenUpEarly) {
  Trials trials{cubeOneFaceLit(0.9)};
  EXPECT_FALSE(trials.find(0.001).mesh);
  EXPECT_EQ(trials.tried.size(), 1u);
}

TEST(CoarseMesh, IsFinerTheSmallerTheError) {
  std::uint32_t before = 0;
  for (const double error : {0.2, 0.003}) {
    const CoarseMesh found = Trials{parallelSquares(0.5)}.find(error);
    ASSERT_TRUE(found.mesh) << error;
    EXPECT_LE(found.solved.error.high, 1.5 * error);
    EXPECT_GT(found.mesh->element_count, before);
    before = found.mesh->element_count;
  }
}

// Small or narrow lamps may light what no trial looks at, and scenes of many surfaces have no coarse mesh.
TEST(CoarseMesh, IsNotTriedWhereTrialsTellNothing) {
  const auto lampOf = [](double width, double depth) {
    SceneBuilder b;
    const auto grey = b.material("grey", glm::dvec3(0.5)),
               lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(9));
    b.quad(grey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    b.quad(lamp, {0.1, 1, 0.1}, {width, 0, 0}, {0, 0, depth});
    return b.finish();
  };
  const auto coarsest = [](const Scene& scene) { return meshOf(scene, 1); };
  EXPECT_TRUE(mayBeCoarse(*coarsest(lampOf(0.8, 0.8)), 2500));
  EXPECT_FALSE(mayBeCoarse(*coarsest(lampOf(0.02, 0.02)), 2500));
  EXPECT_FALSE(mayBeCoarse(*coarsest(lampOf(0.8, 0.02)), 2500));
  EXPECT_FALSE(mayBeCoarse(*coarsest(concentricSpheres(0.5, 1, 0.5, 0, 8)), 2500));
}

}  // namespace
}  // namespace unshot
