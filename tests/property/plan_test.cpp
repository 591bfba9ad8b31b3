// What the plan leaves out changes nothing: each decision on and off, on the scenes where it is taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <string>

#include "scene/obj_reader.h"
#include "session/scene_plan.h"
#include "support/assets.h"
#include "support/plan_pairs.h"
#include "support/random_scene.h"
#include "support/sanitized.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

Scene roomWithBoxes() {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5, 0.6, 0.7)),
             lamp = b.material("lamp", glm::dvec3(0.3), glm::dvec3(4));
  addBox(b, allOf(grey), {0, 0, 0}, {4, 3, 4}, true);
  addBox(b, allOf(grey), {1, 0, 1}, {1, 1, 1}, false);
  addBox(b, allOf(grey), {2.4, 1, 2}, {0.5, 0.5, 0.7}, false);
  b.quad(lamp, {2, 2.9, 1}, {1, 0, 0}, {0, 0, 1});
  return b.finish();
}

class DarkSides : public testing::TestWithParam<FormFactorMethodRow> {};

// On the same elements, with the same form factors between them: to the solver's error. At vertices, whose
// numbers change, rays go elsewhere at random.
TEST_P(DarkSides, HaveNoPartInTheLight) {
  SolveOptions options = optionsOf(GetParam().info.key, 1, 1e-6);
  options.elements.reset();
  options.element_size = 0.5;  // so few that each is a patch, with and without
  options.mode = "gmres";
  const Pair pair = solvedBothWays(roomWithBoxes, options, plan_keys::kDarkSides);
  // Walls, lamp, one box and the other but for its bottom; with them the insides of both boxes.
  EXPECT_EQ(pair.without->mesh().sides.size(), 6u + 2 + 6 + 5);
  EXPECT_GE(pair.with->mesh().sides.size(), 19u + 12);
  const double apart = difference(*pair.with, *pair.without);
  measured("apart", apart);
  EXPECT_LT(apart, GetParam().receivers == ReceiverKind::kElements ? 1e-5 : 0.01);
}

INSTANTIATE_TEST_SUITE_P(Methods, DarkSides, testing::ValuesIn(occludingMethods()),
                         [](const auto& row) { return testName(row.param.info.key); });

// In scenes that nobody would think of, what is left out receives nothing where it is solved.
TEST(Plan, LeavesOutDarkSidesOnlyInRandomScenes) {
  std::size_t scenes = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SolveOptions options = optionsOf("hemicube", 60, 0.05);
    options.hemicube_resolution = 32;
    const auto without = begun(RandomScene(seed).scene(), options);
    if (keysOf(*without).count("dark-sides") == 0) continue;
    options.do_anyway = {std::string(plan_keys::kDarkSides)};
    const auto with = begun(RandomScene(seed).scene(), options);
    while (with->state() == SolveState::kRunning) with->step(Solve::kMostAtOnce);
    const Mesh& mesh = with->mesh();
    const Snapshot snapshot = with->snapshot();
    double arrived = 0;
    for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
      const Side& side = mesh.sides[mesh.element_side[e]];
      const Surface& lit = without->mesh().surfaces[side.surface];
      if (lit.side[side.back ? 1 : 0] != kNone) continue;
      const glm::vec3& h = snapshot.element_irradiance[e];
      arrived += mesh.element_area[e] * static_cast<double>(h.x + h.y + h.z);
    }
    // A pixel or two at an outline may show the wrong side.
    EXPECT_LE(arrived, 1e-3 * with->energy().emitted) << "seed " << seed;
    ++scenes;
  }
  EXPECT_GT(scenes, 10u);
}

// Rays then see that nothing occludes: the same factors, but for single precision.
TEST(Plan, LeavesOutTestsOfOcclusionWhereNothingCanOcclude) {
  for (const double rho : {0.5, 0.9}) {
    SolveOptions options = soonest(1e-6);
    options.elements = 600;
    const Pair pair = solvedBothWays([&] { return cubeOneFaceLit(rho); }, options, plan_keys::kOcclusion);
    EXPECT_EQ(pair.without->formFactorsKey(), "closed-form");
    EXPECT_NE(pair.with->formFactorsKey(), "closed-form");
    const double apart = difference(*pair.with, *pair.without);
    measured("apart", apart);
    EXPECT_LT(apart, 1e-3);
  }
}

// Those that change mesh or method: either is as near to the truth as was asked for.
class WithinTheError : public testing::TestWithParam<std::string_view> {};

TEST_P(WithinTheError, OfTheScene) {
  constexpr double kError = 0.02;
  const Pair pair = solvedBothWays(publishedCornellBox, soonest(kError), GetParam());
  const double apart = difference(*pair.without, *pair.with);
  measured("apart", apart);
  // Counted pixels on an even mesh, which hemicubes go with, are 2.4 % off by themselves.
  EXPECT_LT(apart, 2 * kError + (GetParam() == plan_keys::kHemicubes ? 0.03 : 0));
}

INSTANTIATE_TEST_SUITE_P(Decisions, WithinTheError,
                         testing::Values(plan_keys::kTriangles, plan_keys::kHemicubes, plan_keys::kEvenLight),
                         [](const auto& key) { return testName(key.param); });

// A room as some programs write it, its walls cut into so many squares along each edge, with a block in it.
Scene roomOfSquares(int along) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5, 0.6, 0.7)),
             lamp = b.material("lamp", glm::dvec3(0.3), glm::dvec3(4));
  const auto wall = [&](const glm::dvec3& corner, glm::dvec3 u, glm::dvec3 v) {
    u /= along;
    v /= along;
    for (int i = 0; i < along; ++i) {
      for (int j = 0; j < along; ++j) b.quad(grey, corner + double(i) * u + double(j) * v, u, v);
    }
  };
  const glm::dvec3 x(4, 0, 0), y(0, 3, 0), z(0, 0, 4);
  wall({0, 0, 0}, z, x);
  wall(y, x, z);
  wall({0, 0, 0}, x, y);
  wall(z, y, x);
  wall({0, 0, 0}, y, z);
  wall(x, z, y);
  addBox(b, allOf(grey), {1, 0.5, 1}, {1, 1, 1}, false);
  b.quad(lamp, {2, 2.9, 1}, {1, 0, 0}, {0, 0, 1});
  return b.finish();
}

// Else each of them is a patch at least.
TEST(Plan, SavesPatchesWhereFlatWallsAreCutIntoMany) {
  const Pair pair = solvedBothWays([] { return roomOfSquares(20); }, soonest(0.02), plan_keys::kTriangles);
  const auto cpu = [](const Solve& solve) { return solve.seconds().cpu_solve; };
  measured("patches", pair.without->mesh().patch_count);
  measured("patches otherwise", pair.with->mesh().patch_count);
  const double cpu_ratio = cpu(*pair.without) / cpu(*pair.with);
  measured("CPU over what it is otherwise", cpu_ratio);
  if (!kSanitized) {
    EXPECT_LT(cpu_ratio, 0.6);
  }
  EXPECT_LT(4 * pair.without->mesh().patch_count, pair.with->mesh().patch_count);
}

// A dome over a floor, which does not close it: outside it has an element on each face at least.
TEST(Plan, SavesElementsOutsideOfADome) {
  const auto dome = [] {
    constexpr int kDomeRings = 10;
    SceneBuilder b;
    const auto grey = b.material("grey", glm::dvec3(0.5)),
               lamp = b.material("lamp", glm::dvec3(0.3), glm::dvec3(4));
    const auto at = [](int ring, int step) {
      const double up = 1.5 * ring / kDomeRings,
                   around = 2 * std::acos(-1) * (step % (4 * kDomeRings)) / (4 * kDomeRings);
      return glm::dvec3(std::sin(up) * std::cos(around), std::cos(up), std::sin(up) * std::sin(around));
    };
    for (int ring = 0; ring < kDomeRings; ++ring) {
      for (int step = 0; step < 4 * kDomeRings; ++step) {
        b.polygon(grey, {at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)});
        if (ring > 0) b.polygon(grey, {at(ring, step), at(ring + 1, step + 1), at(ring, step + 1)});
      }
    }
    b.quad(grey, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    b.quad(lamp, {-0.2, 0.7, -0.2}, {0.4, 0, 0}, {0, 0, 0.4});
    return b.finish();
  };
  const Pair pair = solvedBothWays(dome, soonest(0.02), plan_keys::kOuterSides);
  measured("elements", pair.without->mesh().element_count);
  measured("elements otherwise", pair.with->mesh().element_count);
  EXPECT_LT(1.4 * pair.without->mesh().element_count, pair.with->mesh().element_count);
}

// A room with a black curtain before one of its walls, open at one end: in closed ones rows may be closed,
// for which all columns are needed.
TEST(Plan, SavesFormFactorsOfPatchesThatNeedNotShoot) {
  const auto room = [] {
    SceneBuilder b;
    const auto grey = b.material("grey", glm::dvec3(0.5, 0.6, 0.7)), black = b.material("black", {0, 0, 0}),
               lamp = b.material("lamp", glm::dvec3(0.3), glm::dvec3(4));
    addBox(b, {grey, grey, grey, grey, grey, kNone}, {0, 0, 0}, {4, 3, 4}, true);
    b.quad(black, {0.1, 0, 0.1}, {0, 2.9, 0}, {0, 0, 3.8});
    b.quad(lamp, {2, 2.9, 1}, {1, 0, 0}, {0, 0, 1});
    return b.finish();
  };
  const Pair pair = solvedBothWays(room, soonest(0.03), plan_keys::kShooters);
  const auto rows = [](const Solve& solve) { return solve.measures().rows; };
  EXPECT_EQ(rows(*pair.with), pair.with->mesh().patch_count);
  measured("columns over those of all patches",
           static_cast<double>(rows(*pair.without)) / static_cast<double>(rows(*pair.with)));
  EXPECT_LT(rows(*pair.without), 0.95 * static_cast<double>(rows(*pair.with)));
  // No more than what both leave of the solver's error.
  const double apart = difference(*pair.with, *pair.without);
  measured("apart", apart);
  EXPECT_LT(apart, pair.with->measures().solverBound() + pair.without->measures().solverBound());
}

// Both on one mesh: what is apart is no more than what both leave of the solver's error.
TEST(Plan, SumsBouncesInsteadOfShots) {
  const Pair pair = solvedBothWays(publishedCornellBox, soonest(0.02), plan_keys::kShots);
  EXPECT_EQ(pair.without->modeKey(), "southwell");
  measured("shots", static_cast<double>(pair.without->measures().shots));
  measured("shots otherwise", static_cast<double>(pair.with->measures().shots));
  EXPECT_LT(pair.without->measures().shots, pair.with->measures().shots);
  const double apart = difference(*pair.with, *pair.without);
  measured("apart", apart);
  EXPECT_LT(apart, pair.with->measures().solverBound() + pair.without->measures().solverBound());
  // A mode that is asked for does what it does.
  SolveOptions options = soonest(0.02);
  options.mode = "southwell";
  EXPECT_EQ(keysOf(*solved(publishedCornellBox(), options)).count(std::string(plan_keys::kShots)), 0u);
}

TEST(Plan, SolvesForAllBouncesTogetherWhereMuchIsReflected) {
  const auto white = [] {
    Scene scene = publishedCornellBox();
    for (Material& material : scene.materials) material.reflectance = glm::dvec3(0.97);
    return scene;
  };
  const Pair pair = solvedBothWays(white, soonest(0.05), plan_keys::kShots);
  EXPECT_EQ(pair.without->modeKey(), "gmres");
  EXPECT_EQ(pair.with->modeKey(), "southwell");
  const double apart = difference(*pair.with, *pair.without);
  measured("apart", apart);
  EXPECT_LT(apart, pair.with->measures().solverBound() + pair.without->measures().solverBound());
  Solve& solve = *pair.without;
  solve.setMode("jacobi");
  EXPECT_EQ(keysOf(solve).count(std::string(plan_keys::kShots)), 0u);
}

// A grey room with a block in it, but for a trace of red in the block.
Scene greyRoom(double red) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.6)),
             block = b.material("block", glm::dvec3(0.4) + glm::dvec3(red, 0, 0)),
             lamp = b.material("lamp", glm::dvec3(0.3), glm::dvec3(4));
  addBox(b, allOf(grey), {0, 0, 0}, {4, 3, 4}, true);
  addBox(b, allOf(block), {1, 0.5, 1}, {1, 1, 1}, false);
  b.quad(lamp, {2, 2.9, 1}, {1, 0, 0}, {0, 0, 1});
  return b.finish();
}

// "one", "two", or none.
std::string channelsLeftOut(const Solve& solve) {
  for (const PlanDecision& d : solve.plan()) {
    if (d.key == plan_keys::kChannels) return d.what.substr(0, 3);
  }
  return {};
}

// The same to the last bit, whatever the mode.
TEST(Plan, WorksOutGreyLightInOneChannel) {
  for (const char* mode : {"southwell", "gmres", "chebyshev"}) {
    SolveOptions options = soonest(0.02);
    options.mode = mode;
    const Pair pair = solvedBothWays([] { return greyRoom(0); }, options, plan_keys::kChannels);
    EXPECT_EQ(pair.without->measures().shots, pair.with->measures().shots) << mode;
    EXPECT_EQ(pair.without->measures().bounds.upper, pair.with->measures().bounds.upper) << mode;
    EXPECT_EQ(pair.without->snapshot().irradiance, pair.with->snapshot().irradiance) << mode;
    for (const glm::vec3& h : pair.without->snapshot().irradiance) ASSERT_TRUE(h.x == h.y && h.y == h.z);
  }
  // Green and blue are alike still.
  EXPECT_EQ(channelsLeftOut(*solved(greyRoom(1e-6), soonest(0.02))), "one");
}

// A room of these walls with a block in it, and a lamp.
Scene litRoom(const glm::dvec3& walls, const glm::dvec3& block, const glm::dvec3& emission,
              const glm::dvec3& block_emits = glm::dvec3(0.0)) {
  SceneBuilder b;
  const auto wall = b.material("wall", walls), of_block = b.material("block", block, block_emits),
             lamp = b.material("lamp", glm::dvec3(0.3), emission);
  addBox(b, allOf(wall), {0, 0, 0}, {4, 3, 4}, true);
  addBox(b, allOf(of_block), {1, 0.5, 1}, {1, 1, 1}, false);
  b.quad(lamp, {2, 2.9, 1}, {1, 0, 0}, {0, 0, 1});
  return b.finish();
}

const glm::dvec3 kWarm(10, 9.6, 8.8);  // light of a lamp

TEST(Plan, TakesChannelsInProportionFromOne) {
  for (const char* mode : {"southwell", "gmres", "chebyshev"}) {
    SolveOptions options = soonest(0.02);
    options.mode = mode;
    const auto make = [] { return litRoom(glm::dvec3(0.6), glm::dvec3(0.4), kWarm); };
    const Pair pair = solvedBothWays(make, options, plan_keys::kChannels);
    const auto &h = pair.without->snapshot().irradiance, &of_all = pair.with->snapshot().irradiance;
    ASSERT_EQ(h.size(), of_all.size());
    for (std::size_t v = 0; v < h.size(); ++v) {
      const float rounding = 1e-5f * (1 + of_all[v].x);
      EXPECT_NEAR(h[v].y, 0.96f * h[v].x, rounding) << mode;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(h[v][c], of_all[v][c], rounding) << mode;
    }
    EXPECT_NEAR(pair.without->measures().bounds.upper, pair.with->measures().bounds.upper,
                1e-6 * pair.with->measures().bounds.upper)
        << mode;
  }
}

TEST(Plan, LeavesChannelsDarkThatNothingEmits) {
  for (const char* mode : {"southwell", "gmres", "chebyshev", "jacobi"}) {
    SolveOptions options = soonest(0.02);
    options.mode = mode;
    const auto make = [] { return litRoom({0.6, 0.5, 0.4}, {0, 0.9, 0.3}, {0, 4, 0}); };
    const Pair pair = solvedBothWays(make, options, plan_keys::kChannels);
    EXPECT_EQ(pair.without->measures().shots, pair.with->measures().shots) << mode;
    const Snapshot snapshot = pair.without->snapshot();
    EXPECT_EQ(snapshot.irradiance, pair.with->snapshot().irradiance) << mode;
    for (const glm::vec3& h : snapshot.irradiance) ASSERT_TRUE(h.x == 0 && h.z == 0) << mode;
    for (const glm::vec3& a : snapshot.ambient) ASSERT_TRUE(a.x == 0 && a.z == 0) << mode;
  }
}

TEST(Plan, IsNotFooledByChannelsThatAreNotAlike) {
  const glm::dvec3 half(0.5);
  const auto leftOut = [](const glm::dvec3& walls, const glm::dvec3& block, const glm::dvec3& lamp,
                          const glm::dvec3& block_too = glm::dvec3(0.0)) {
    return channelsLeftOut(*begun(litRoom(walls, block, lamp, block_too), optionsOf("rays", 60, 0.1)));
  };
  EXPECT_EQ(leftOut(half, half, kWarm), "two");
  EXPECT_EQ(leftOut(half, half, kWarm, 0.7 * kWarm), "two");
  EXPECT_EQ(leftOut({0.5, 0.5, 0.4}, half, kWarm), "one");
  EXPECT_EQ(leftOut({0.5, 0.4, 0.3}, half, {1, 2, 0}), "one");
  EXPECT_EQ(leftOut({0.5, 0.4, 0.3}, half, {0, 2, 0}), "two");
  // Grey to 1e-6, in proportion but for what reflects, black in two channels, all but dark.
  EXPECT_EQ(leftOut(half + glm::dvec3(1e-6, -1e-6, 0), half, kWarm), "");
  EXPECT_EQ(leftOut(half, half, kWarm, kWarm * (1.0 + glm::dvec3(1e-6, 0, 0))), "one");
  EXPECT_EQ(leftOut({0.5, 0.4, 0.3}, half, kWarm), "");
  EXPECT_EQ(leftOut(half, {0.9, 0, 0.1}, kWarm), "");
  EXPECT_EQ(leftOut({0.5, 0.4, 0.3}, {0, 0, 0.5}, {1, 2, 1e-9}), "");
}

// Whatever was left out before, it is as if the scene had been so from the start.
TEST(Plan, TakesChannelsUpAgainThatAnEditLights) {
  const auto gl = []() -> gl::Context& { return sharedContext(); };
  const SolveOptions options = soonest(0.005);
  const glm::dvec3 half(0.5), coloured(0.7, 0.5, 0.3);
  const struct {
    Scene before, after;
    const char* left_out_after;
  } edits[] = {{litRoom(coloured, half, {4, 0, 0}), litRoom(coloured, half, {4, 3, 2}), ""},
               {litRoom(half, half, kWarm), litRoom(half, coloured, kWarm), ""},
               {litRoom(half, half, kWarm), litRoom(half, half, {1, 2, 9}), "two"},
               {litRoom(coloured, half, kWarm), litRoom(coloured, half, {0, 0, 5}), "two"}};
  for (const auto& edit : edits) {
    const auto before = solved(edit.before, options);
    Solve after(*before, edit.after.materials, gl);
    EXPECT_EQ(channelsLeftOut(after), edit.left_out_after);
    while (after.state() == SolveState::kRunning) after.step();
    EXPECT_EQ(after.state(), SolveState::kConverged);
    const double apart = difference(*solved(edit.after, options), after);
    measured("apart", apart);
    EXPECT_LT(apart, 2 * options.error);
  }
}

// Light that was coloured before the materials were made grey goes on channel by channel.
TEST(Plan, IsNotFooledByColouredLightThatIsLeftInAGreyScene) {
  const auto gl = []() -> gl::Context& { return sharedContext(); };
  const SolveOptions options = soonest(0.005);
  const auto before = solved(greyRoom(0.4), options);
  EXPECT_EQ(channelsLeftOut(*before), "one");
  Solve after(*before, greyRoom(0).materials, gl);
  EXPECT_EQ(channelsLeftOut(after), "two");
  EXPECT_EQ(after.state(), SolveState::kRunning);
  while (after.state() == SolveState::kRunning) after.step();
  const double apart = difference(*solved(greyRoom(0), options), after);
  measured("apart", apart);
  EXPECT_LT(apart, 2 * options.error);
}

TEST(Plan, IsSwitchedOffAsAWhole) {
  SolveOptions options = soonest(0.05);
  options.do_anyway = doAll();
  const auto solve = solved(publishedCornellBox(), options);
  for (const PlanDecision& decision : solve->plan()) EXPECT_EQ(decision.key, plan_keys::kShooters);
  EXPECT_EQ(solve->formFactorsKey(), "hemicube");
  EXPECT_EQ(solve->mesh().sides.size(), 2 * solve->mesh().surfaces.size());
}

class PlanCost : public testing::TestWithParam<const char*> {};

// A twentieth of the solve at most, or no longer than a person sees. The least of three, as other programs
// make either longer.
TEST_P(PlanCost, IsLittle) {
  double share = 1, seconds = 1;
  for (int k = 0; k < 3; ++k) {
    SolveOptions options = soonest(0.02);
    options.emit_front_only = true;
    const auto solve = solved(readObj(asset(GetParam())), options);
    share = std::min(share, solve->seconds().plan / solve->seconds().cpu_solve);
    seconds = std::min(seconds, solve->seconds().plan);
  }
  measured("plan over the solve", share);
  measured("plan [ms]", 1e3 * seconds);
  EXPECT_TRUE(share < 0.05 || seconds < 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PlanCost,
                         testing::Values("furnace.obj", "two_patches.obj", "cornell_box.obj",
                                         "two_rooms.obj"),
                         [](const auto& row) { return std::string(row.param, std::strlen(row.param) - 4); });

}  // namespace
}  // namespace unshot
