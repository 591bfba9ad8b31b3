// A finer mesh while the solve is live: what was shot goes over, and the end is that of a solve that began on
// the finer mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/obj_reader.h"
#include "support/assets.h"
#include "support/error_of.h"
#include "support/given_up.h"
#include "support/solve_cases.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

SolveOptions following(double error) {
  SolveOptions options;
  options.form_factors = "rays";
  options.error = error;
  return options;
}

std::unique_ptr<Solve> box(const SolveOptions& options) {
  return solved(readObj(asset("cornell_box.obj")), options);
}

std::unique_ptr<Solve> finerThan(const Solve& before) {
  return std::make_unique<Solve>(before, []() -> gl::Context& { return sharedContext(); });
}

double reflectedPower(const Solve& solve) {
  const Mesh& mesh = solve.mesh();
  const std::vector<glm::dvec3> b = solve.patchRadiosity();
  double sum = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const glm::dvec3 reflected = b[q] - mesh.sides[mesh.patch_side[q]].emission;
    sum += mesh.patch_area[q] * (reflected.x + reflected.y + reflected.z);
  }
  return sum;
}

// A room with a block and two lamps, of which the first is on.
Scene roomOfTwoLamps() {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(0.5)),
             above = b.material("above", glm::dvec3(0.5), glm::dvec3(5.0)),
             beside = b.material("beside", glm::dvec3(0.5));
  addBox(b, {white, white, white, white, white, white}, {0, 0, 0}, {1, 1, 1}, true);
  addBox(b, {white, white, white, white, white, white}, {0.45, 0.1, 0.35}, {0.2, 0.3, 0.3}, false);
  b.quad(above, {0.4, 0.9, 0.4}, {0.3, 0, 0}, {0, 0, 0.3});
  b.quad(beside, {0.1, 0.2, 0.45}, {0, 0.05, 0}, {0, 0, 0.05});
  return b.finish();
}

constexpr double kCoarse = 0.06, kFine = 0.02;

TEST(FinerMesh, GoesOnWithWhatWasShot) {
  const auto coarse = box(following(kCoarse));
  EXPECT_EQ(coarse->finerMeshError(), std::nullopt);
  coarse->setError(kFine);
  run(*coarse);
  ASSERT_EQ(coarse->finerMeshError(), kFine);
  const std::vector<glm::dvec3> before = coarse->patchRadiosity();
  const auto finer = finerThan(*coarse);
  const auto fresh = box(following(kFine));
  // It is the mesh of a solve that began with this error.
  EXPECT_GT(finer->mesh().patch_count, coarse->mesh().patch_count);
  EXPECT_EQ(finer->mesh().element_count, fresh->mesh().element_count);
  EXPECT_TRUE(finer->takesOver());
  const std::uint64_t shots = finer->measures().shots;
  EXPECT_EQ(shots, coarse->measures().shots);
  const double progress = finer->progress();
  while (finer->takesOver()) finer->step();
  EXPECT_GT(finer->progress(), progress);
  // One shot a patch, and little is left of it: patches of the coarse mesh are off by some of the error that
  // it was made for, and what was shot and received differ by twice that at most.
  EXPECT_LE(finer->measures().shots, shots + finer->mesh().patch_count);
  EXPECT_LE(finer->measures().unshot_fraction, 2 * kCoarse);
  EXPECT_GT(finer->measures().unshot_fraction, 1e-4) << "the finer mesh knows better";
  EXPECT_NEAR(reflectedPower(*finer) / reflectedPower(*coarse), 1, kCoarse);
  run(*finer);
  ASSERT_EQ(finer->state(), SolveState::kConverged) << finer->stoppedBy();
  EXPECT_NEAR(finer->energy().residual(), 0, 1e-9 * finer->energy().emitted);
  EXPECT_EQ(finer->finerMeshError(), std::nullopt);
  EXPECT_LE(rmsDifference(finer->snapshot().irradiance, fresh->snapshot().irradiance),
            2 * (finer->measures().solverBound() + fresh->measures().solverBound()));
  // The solve before is as it was.
  EXPECT_EQ(coarse->patchRadiosity(), before);
  EXPECT_EQ(coarse->state(), SolveState::kConverged);
}

TEST(FinerMesh, IsNoneWhereThereIsNothingToBeHad) {
  SolveOptions even = following(kCoarse);
  even.elements = 300;
  const auto uniform = box(even);
  uniform->setError(kFine);
  run(*uniform);
  EXPECT_EQ(uniform->finerMeshError(), std::nullopt) << "a mesh that was asked for";
  SolveOptions few = following(kCoarse);
  const std::size_t elements = box(few)->mesh().element_count;
  few.max_elements = elements;
  const auto full = box(few);
  full->setError(kFine);
  run(*full);
  EXPECT_EQ(full->finerMeshError(), std::nullopt) << "as many elements as there may be";
  const auto running = begun(readObj(asset("cornell_box.obj")), following(kFine));
  running->setError(kFine / 2);
  EXPECT_EQ(running->finerMeshError(), std::nullopt) << "not solved yet";
  EXPECT_EQ(errorOf([&] { finerThan(*running); }).kind(), ErrorKind::kUsage);
}

TEST(FinerMesh, FollowsAnEditToo) {
  const auto coarse = box(following(kCoarse));
  std::vector<Material> materials = coarse->scene().materials;
  for (Material& m : materials) m.reflectance *= 0.5;
  Solve edited(*coarse, materials, []() -> gl::Context& { return sharedContext(); });
  run(edited);
  edited.setError(kFine);
  run(edited);
  ASSERT_EQ(edited.finerMeshError(), kFine);
  const auto finer = finerThan(edited);
  run(*finer);
  Scene scene = readObj(asset("cornell_box.obj"));
  scene.materials = materials;
  const auto fresh = solved(scene, following(kFine));
  ASSERT_EQ(finer->mesh().element_count, fresh->mesh().element_count);
  EXPECT_LE(rmsDifference(finer->snapshot().irradiance, fresh->snapshot().irradiance),
            2 * (finer->measures().solverBound() + fresh->measures().solverBound()));
}

TEST(FinerMesh, LeavesWhatWasThereWhereItIsGivenUp) {
  const auto coarse = box(following(kCoarse));
  coarse->setError(kFine);
  run(*coarse);
  const std::vector<glm::dvec3> before = coarse->patchRadiosity();
  givenUpAt(0.5, [&](const CancelToken& cancel) {
    Solve(
        *coarse, []() -> gl::Context& { return sharedContext(); }, cancel);
  });
  const auto finer = finerThan(*coarse);
  finer->step();
  finer->interrupt();
  EXPECT_EQ(finer->state(), SolveState::kInterrupted);
  EXPECT_TRUE(finer->takesOver()) << "so that what was before is shown and written";
  EXPECT_EQ(coarse->patchRadiosity(), before);
}

// Another lamp, whose shadows the mesh knows nothing of.
TEST(FinerMesh, IsWantedWhereAnotherLampIsSwitchedOn) {
  constexpr double kAsked = 0.02;
  const auto first = solved(roomOfTwoLamps(), following(kAsked));
  first->estimate(512);
  EXPECT_EQ(first->finerMeshError(), std::nullopt);
  std::vector<Material> materials = first->scene().materials;
  std::swap(materials[1].emission, materials[2].emission);
  Solve other(*first, materials, []() -> gl::Context& { return sharedContext(); });
  run(other);
  ASSERT_EQ(other.finerMeshError(), std::nullopt) << "no estimate yet";
  other.estimate(64);
  ASSERT_EQ(other.finerMeshError(), std::nullopt) << "few places say little";
  const double missed = other.estimate(448).total.value;
  ASSERT_GT(other.estimates().total.low, kAsked) << "or this test shows nothing";
  ASSERT_EQ(other.finerMeshError(), kAsked);
  const auto finer = finerThan(other);
  run(*finer);
  EXPECT_LT(finer->estimate(512).total.value, 0.5 * missed);
  EXPECT_EQ(finer->finerMeshError(), std::nullopt);
}

}  // namespace
}  // namespace unshot
