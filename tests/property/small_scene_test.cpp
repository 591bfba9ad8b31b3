// Small scenes: a coarse mesh where light is even, and what must not be taken for that.
#include <gtest/gtest.h>

#include "formfactor/transport.h"
#include "mesh/build.h"
#include "scene/obj_reader.h"
#include "session/residual_places.h"
#include "session/scene_plan.h"
#include "support/dice.h"
#include "support/plan_pairs.h"
#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

/// A box whose ceiling is a lamp, all of it or a wide strip, with walls of any colours.
Scene litBox(std::uint64_t seed) {
  Dice dice(seed);
  SceneBuilder b;
  const glm::dvec3 size{dice.between(1, 5), dice.between(1, 5), dice.between(1, 5)};
  const double mean = dice.between(0.1, 0.8);
  const auto colour = [&] {
    return mean * glm::dvec3{dice.between(0.7, 1), dice.between(0.7, 1), dice.between(0.7, 1)};
  };
  BoxMaterials materials;
  for (std::uint32_t& m : materials) m = b.material("wall", colour());
  const double share = dice.uniform() < 0.5 ? 1.0 : dice.between(0.6, 0.9);
  const auto lamp = b.material("lamp", glm::dvec3(0.2), glm::dvec3(1, 2, 4));
  const std::uint32_t ceiling = materials[3];
  materials[3] = kNone;
  addBox(b, materials, {0, 0, 0}, size, true);
  b.quad(lamp, {0, size.y, 0}, {share * size.x, 0, 0}, {0, 0, size.z});
  if (share < 1) b.quad(ceiling, {share * size.x, size.y, 0}, {(1 - share) * size.x, 0, 0}, {0, 0, size.z});
  return b.finish();
}

// With and without: both are within the error that was asked for, of the same scene and of one another.
TEST(SmallScene, TakesCoarseMeshesWithinTheErrorOnly) {
  std::size_t taken = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const double error = seed % 2 == 0 ? 0.03 : 0.08;
    SolveOptions options = soonest(error);
    const auto without = solved(litBox(seed), options);
    EXPECT_EQ(without->formFactorsKey(), "closed-form");
    if (keysOf(*without).count("fineness") == 0) continue;
    ++taken;
    options.do_anyway = {std::string(plan_keys::kFineness)};
    options.error = error / 4;  // near to the truth
    const auto with = solved(litBox(seed), options);
    EXPECT_GT(with->mesh().element_count, without->mesh().element_count);
    const double apart = difference(*without, *with);
    measured("apart over the error asked for", apart / error);
    EXPECT_LT(apart, error + options.error) << seed;  // that of either
  }
  EXPECT_GE(taken, 4u);
}

TEST(SmallScene, IsWithinTheErrorWhereItIsBundled) {
  for (const std::string name : {"furnace", "two_patches"}) {
    const auto make = [&] { return readObj(UNSHOT_SOURCE_DIR "/assets/" + name + ".obj"); };
    SolveOptions options = soonest(0.01);
    options.emit_front_only = true;
    const auto without = solved(make(), options);
    EXPECT_EQ(keysOf(*without).count("fineness"), 1u) << name;
    options.do_anyway = {std::string(plan_keys::kFineness)};
    options.error = 0.003;
    const double apart = difference(*without, *solved(make(), options));
    measured(name + " apart", apart);
    // The middles of elements, where the two are compared, are where a coarse one is farthest from round
    // light.
    EXPECT_LT(apart, 0.02) << name;
  }
}

// A live solve is edited, and the mesh stays: it must do for other light too.
TEST(SmallScene, HasTheUsualMeshWhereItIsLive) {
  SolveOptions options = soonest(0.01);
  options.soonest = false;
  EXPECT_EQ(keysOf(*solved(furnaceScene(0.5, 0.5), options)).count("fineness"), 0u);
}

TEST(SmallScene, IsNotFooledByAChipOfAnOccluder) {
  const auto make = [](bool chip) {
    SceneBuilder b;
    addBox(b, allOf(b.material("glow", glm::dvec3(0.5), glm::dvec3(0.5))), {0, 0, 0}, glm::dvec3(2), true);
    if (chip) b.quad(b.material("chip", glm::dvec3(0.0)), {1, 0.5, 1}, {0.1, 0, 0}, {0, 0, 0.1});
    return b.finish();
  };
  SolveOptions options = soonest(0.02);
  options.emit_front_only = true;
  const auto even = solved(make(false), options), chipped = solved(make(true), options);
  EXPECT_EQ(keysOf(*even).count("fineness"), 1u);
  EXPECT_EQ(keysOf(*chipped).count("fineness"), 0u);
  EXPECT_EQ(keysOf(*chipped).count("occlusion"), 0u);
  // It absorbs what arrives on both of its sides: of 24 m^2 of walls that absorb half, 0.02 m^2.
  const auto mean = [](const Solve& solve) {
    double sum = 0, area = 0;
    const Snapshot snapshot = solve.snapshot();
    for (std::uint32_t e = 0; e < solve.mesh().element_count; ++e) {
      if (!solve.mesh().emits(solve.mesh().element_patch[e])) continue;
      sum += solve.mesh().element_area[e] * static_cast<double>(snapshot.element_irradiance[e].x);
      area += solve.mesh().element_area[e];
    }
    return sum / area;
  };
  EXPECT_NEAR(mean(*even), 1, options.error);
  // The chip ends in the middle of the box, in line with many pairs of vertex and patch, each of which has
  // one ray.
  EXPECT_NEAR(mean(*chipped), 12 / (12 + 0.02), 1.5 * options.error);
}

// B = E / (1 - rho) in each channel by itself. What the solver leaves of it is the same in all, nearly.
TEST(SmallScene, DoesNotTakeNearlyGreyForGrey) {
  SceneBuilder b;
  constexpr double kApart = 1e-6;
  const glm::dvec3 rho(0.5, 0.5 + kApart, 0.5 - kApart);
  addBox(b, allOf(b.material("glow", rho, glm::dvec3(0.5))), {0, 0, 0}, glm::dvec3(1), true);
  SolveOptions options = soonest(0.01);
  options.emit_front_only = true;
  const auto solve = solved(b.finish(), options);
  for (const glm::dvec3& radiosity : solve->patchRadiosity()) {
    EXPECT_NEAR(radiosity.y / radiosity.x - 1, 2 * kApart, 0.1 * kApart);
    EXPECT_NEAR(radiosity.z / radiosity.x - 1, -2 * kApart, 0.1 * kApart);
  }
}

// A wall that is black in two channels sends in the third; a lamp of one channel lights that alone.
TEST(SmallScene, KeepsTheChannelsOfAWallThatIsBlackInTwo) {
  const auto make = [] {
    std::array<Material, 6> materials;
    materials.fill({"grey", glm::dvec3(0.5), glm::dvec3(0.0)});
    materials[1].emission = glm::dvec3(1, 2, 0);
    materials[0].reflectance = glm::dvec3(0.9, 0, 0);
    return cubeScene(materials);
  };
  SolveOptions options = soonest(0.02);
  options.emit_front_only = true;
  const auto without = solved(make(), options);
  options.do_anyway = doAll();
  options.form_factors = "closed-form";
  options.error = 0.005;
  const auto with = solved(make(), options);
  EXPECT_LT(difference(*without, *with), 0.02 + options.error);
  const auto radiosity = sideRadiosities(without->snapshot());
  for (std::size_t s = 0; s < radiosity.size(); ++s) {
    EXPECT_EQ(radiosity[s].z, 0);
    if (without->mesh().sides[s].reflectance.y == 0) {
      EXPECT_EQ(radiosity[s].y, 0);
      EXPECT_GT(radiosity[s].x, 0.1);
    }
  }
}

// The light of the trial is the solve's: nothing is computed twice, and its error is the one that was judged.
// What a mode is asked to do, that mode does, along the same columns.
TEST(SmallScene, BeginsWithTheLightOfItsTrial) {
  const TempFolder folder;
  const std::string path = writeRoom(folder);
  SolveOptions options = soonest(0.02);
  options.emit_front_only = true;
  auto solve = begun(readObj(path), options);
  ASSERT_EQ(keysOf(*solve).count("fineness"), 1u);
  EXPECT_EQ(solve->measures().rows, solve->mesh().patch_count);
  solve->step();
  EXPECT_EQ(solve->state(), SolveState::kConverged);
  EXPECT_EQ(solve->measures().rows, solve->mesh().patch_count);
  EXPECT_LT(solve->measures().solverBound(), 0.4 * options.error);
  const double estimate = solve->estimate(256).total.value;
  measured("error by estimate over what was asked for", estimate / options.error);
  EXPECT_LT(estimate, options.error);
  options.mode = "gauss-seidel";
  const auto by_mode = solved(readObj(path), options);
  EXPECT_EQ(by_mode->measures().rows, by_mode->mesh().patch_count);
  EXPECT_GT(by_mode->measures().shots, by_mode->mesh().patch_count);
  EXPECT_LT(difference(*solve, *by_mode), options.error);
  // From nothing again, along the same columns.
  solve->again();
  EXPECT_EQ(solve->measures().unshot_fraction, 1);
  while (solve->state() == SolveState::kRunning) solve->step();
  EXPECT_GT(solve->measures().shots, 0u);
  EXPECT_LT(difference(*solve, *by_mode), options.error);
}

// The places that a trial was judged at are those of the first estimate, which takes no looks of its own;
// they are those that it would have chosen.
TEST(SmallScene, IsEstimatedAtThePlacesOfItsTrial) {
  const Mesh mesh = buildMesh(cubeOneFaceLit(0.5), {.elements = 200, .element_size = {}});
  const auto method = methodRow("closed-form");
  const Transport transport(makeMethod(method, mesh), makeReceivers(mesh, method.receivers), mesh.patch_area,
                            0);
  MeshField light{std::vector<glm::vec3>(mesh.vertices.size(), glm::vec3(1.0f)),
                  std::vector<glm::vec3>(mesh.element_count, glm::vec3(1.0f))};
  light.vertices.front() = glm::vec3(2.0f);
  ResidualPlaces first(mesh, transport.receivers(), false, 1), at_once(mesh, transport.receivers(), false, 1),
      later(mesh, transport.receivers(), false, 1);
  ASSERT_TRUE(first.exact());
  first.add(64, light);
  later.restore(first.take());
  EXPECT_TRUE(first.points().empty());
  later.add(32, light);
  at_once.add(96, light);
  ASSERT_EQ(later.points().size(), at_once.points().size());
  for (std::size_t k = 0; k < later.points().size(); ++k) {
    EXPECT_EQ(later.points()[k].triangle, at_once.points()[k].triangle);
    EXPECT_EQ(later.points()[k].weights, at_once.points()[k].weights);
    EXPECT_EQ(later.points()[k].looks[0].shares.size(), at_once.points()[k].looks[0].shares.size());
  }
  const TempFolder folder;
  SolveOptions options = soonest(0.02);
  options.emit_front_only = true;
  auto solve = begun(readObj(writeRoom(folder)), options);
  while (solve->state() == SolveState::kRunning) solve->step();
  ASSERT_EQ(keysOf(*solve).count("fineness"), 1u);
  for (const std::size_t places : {64u, 96u}) {
    solve->estimate(places - solve->places());
    EXPECT_EQ(solve->places(), places);
  }
}

// A lamp of a twelfth of the ceiling: the mesh must be fine around it, and is coarse elsewhere.
TEST(SmallScene, TakesACoarseMeshUnderASmallLampToo) {
  const auto room = [] {
    SceneBuilder b;
    const auto grey = b.material("grey", glm::dvec3(0.5)),
               lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(10));
    BoxMaterials walls = allOf(grey);
    walls[3] = kNone;
    addBox(b, walls, {0, 0, 0}, {4, 2.5, 3}, true);
    b.quad(grey, {0, 2.5, 0}, {4, 0, 0}, {0, 0, 1});
    b.quad(grey, {0, 2.5, 2}, {4, 0, 0}, {0, 0, 1});
    b.quad(grey, {0, 2.5, 1}, {1.5, 0, 0}, {0, 0, 1});
    b.quad(grey, {2.5, 2.5, 1}, {1.5, 0, 0}, {0, 0, 1});
    b.quad(lamp, {1.5, 2.5, 1}, {1, 0, 0}, {0, 0, 1});
    return b.finish();
  };
  SolveOptions options = soonest(0.05);
  options.emit_front_only = true;
  const Pair pair = solvedBothWays(room, options, plan_keys::kFineness);
  EXPECT_LT(pair.without->mesh().element_count, pair.with->mesh().element_count);
  SolveOptions finer = options;  // near to the truth
  finer.error = options.error / 4;
  finer.do_anyway = {std::string(plan_keys::kFineness)};
  const double apart = difference(*solved(room(), finer), *pair.without);
  measured("apart over the error asked for", apart / options.error);
  EXPECT_LT(apart, options.error + finer.error);
}

// What is left out of a small scene whose light is even or smooth. Twenty times is asked for; both runs are
// in one process and on one clock of CPU, and the furnace takes a thousandth here, the others a hundredth.
// Counted, they are no more factors between patches and vertices than this.
TEST(SmallScene, MakesShortWorkOfSmallScenes) {
  if (kSanitized) GTEST_SKIP() << "everything takes far longer";
  const TempFolder folder;
  const std::filesystem::path assets(UNSHOT_SOURCE_DIR "/assets");
  for (const auto& [path, most_factors] :
       {std::pair(assets / "furnace.obj", 1e3), std::pair(assets / "two_patches.obj", 15e3),
        std::pair(std::filesystem::path(writeRoom(folder)), 30e3)}) {
    const std::string name = path.stem().string();
    const auto make = [&path = path] { return readObj(path); };
    SolveOptions options = soonest(0.01);
    options.emit_front_only = true;
    double factors = 0;
    const auto seconds = [&](const SolveOptions& how) {
      const auto solve = solved(make(), how);
      solve->estimate(64);
      factors = static_cast<double>(solve->measures().rows * solve->mesh().vertices.size());
      return std::pair(solve->seconds().cpu_solve, solve->drawn());
    };
    seconds(options);  // with what is loaded once
    const auto [lean, lean_drawn] = seconds(options);
    measured(name + " factors", factors);
    EXPECT_LT(factors, most_factors);
    options.do_anyway = doAll();
    const auto [whole, whole_drawn] = seconds(options);
    measured(name + " CPU ms", 1e3 * lean);
    measured(name + " with everything", 1e3 * whole);
    EXPECT_EQ(lean_drawn, 0u);
    EXPECT_GT(whole_drawn, 0u);
    EXPECT_LT(20 * lean, whole) << name;
  }
}

}  // namespace
}  // namespace unshot
