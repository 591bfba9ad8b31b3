// Other materials while the solve is live: S, H and form factors stay, and the end is that of a solve that
// began with them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "session/saved_solve.h"
#include "support/solve_cases.h"
#include "support/solving.h"
#include "support/temp_folder.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

enum Materials : std::size_t { kWhite, kRed, kLight, kBlack };

// A closed room with three faces of a block in it, a light below the ceiling and a black floor.
Scene roomToEdit(double reflectance = 0.7) {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(reflectance)),
             red = b.material("red", reflectance * glm::dvec3(1, 0.2, 0.2)),
             light = b.material("light", glm::dvec3(0.3), {5, 4, 3}),
             black = b.material("black", glm::dvec3(0.0));
  addBox(b, {red, white, black, white, red, white}, {0, 0, 0}, {1, 1, 1}, true);
  addBox(b, {white, kNone, kNone, white, white, kNone}, {0.2, 0, 0.2}, {0.3, 0.4, 0.3}, false);
  b.quad(light, {0.6, 0.9, 0.6}, {0.2, 0, 0}, {0, 0, 0.2});
  return b.finish();
}

struct EditCase {
  std::string_view name;
  SolveCase solve;
};

SolveOptions optionsToEdit(const SolveCase& c) { return optionsOf(c, 0.02); }

gl::Context& context() { return sharedContext(); }

std::unique_ptr<Solve> edited(Solve& before, const std::function<void(std::vector<Material>&)>& change) {
  std::vector<Material> materials = before.scene().materials;
  change(materials);
  return std::make_unique<Solve>(before, materials, context);
}

// The same mesh and materials from nothing shot.
std::unique_ptr<Solve> afresh(const Solve& solve, const SolveCase& c) {
  SolveOptions options = optionsToEdit(c);
  options.mesh = solve.snapshot().mesh;
  return solved(solve.scene(), options);
}

// Bounds are of what patches reflect, by area, and here vertices count alike.
constexpr double kNorms = 2;
// Form factors are held in single precision.
constexpr double kRounding = 1e-6;

void expectAsAfresh(Solve& solve, const SolveCase& c) {
  run(solve);
  ASSERT_EQ(solve.state(), SolveState::kConverged) << solve.stoppedBy();
  EXPECT_NEAR(solve.energy().residual(), 0, 1e-9 * solve.energy().emitted);
  const auto other = afresh(solve, c);
  const Snapshot a = solve.snapshot(), b = other->snapshot();
  const double bounds = solve.measures().solverBound() + other->measures().solverBound();
  EXPECT_LE(rmsDifference(a.irradiance, b.irradiance), kNorms * bounds + kRounding);
  // Direct light takes no iteration.
  ASSERT_TRUE(a.direct && b.direct);
  EXPECT_LE(rmsDifference(*a.direct, *b.direct), kRounding);
}

class Edits : public testing::TestWithParam<EditCase> {};

TEST_P(Edits, EndAsASolveThatBeganWithThem) {
  const SolveCase& c = GetParam().solve;
  auto solve = begun(roomToEdit(c.white), optionsToEdit(c));
  run(*solve);
  ASSERT_EQ(solve->state(), SolveState::kConverged) << solve->stoppedBy();
  const auto edit = [&](const char* what, const std::function<void(std::vector<Material>&)>& change,
                        int most_steps = 1'000'000) {
    SCOPED_TRACE(what);
    const std::uint64_t shots = solve->measures().shots, rows = solve->measures().rows;
    solve = edited(*solve, change);
    EXPECT_EQ(solve->measures().shots, shots);
    run(*solve, most_steps);
    if (most_steps == 1'000'000) expectAsAfresh(*solve, c);
    // What is at hand is not computed again: only columns of patches that were black or begin to emit.
    if (c.kept_bytes > 0) {
      EXPECT_LE(solve->measures().rows - rows, solve->mesh().patch_count / 2);
    }
  };
  edit("a wall's colour", [](auto& m) { m[kRed].reflectance = {0.2, 0.2, 0.7}; });
  edit("a dimmer lamp of another colour", [](auto& m) { m[kLight].emission = {1, 4, 6}; });
  edit(
      "a brighter one, left on its way",
      [](auto& m) {
        m[kLight].emission = {20, 5, 5};
      },
      7);
  edit("a lamp off, a wall on", [](auto& m) {
    m[kLight].emission = glm::dvec3(0.0);
    m[kRed].emission = {0.5, 0.1, 0};
  });
  edit("a black floor white", [](auto& m) { m[kBlack].reflectance = glm::dvec3(0.5); });
  edit("the wall off, the lamp on", [](auto& m) {
    m[kLight].emission = {5, 4, 3};
    m[kRed].emission = glm::dvec3(0.0);
  });
}

INSTANTIATE_TEST_SUITE_P(
    Solves, Edits,
    testing::Values(EditCase{"Hemicube", {"hemicube", "southwell"}},
                    EditCase{"HemicubeByGmres", {"hemicube", "gmres"}},
                    EditCase{"KeepingNothing", {"rays", "southwell", false, 0}},
                    EditCase{"Visibility", {"hemicube-visibility", "jacobi"}},
                    EditCase{"Rays", {"rays", "conjugate-gradient"}},
                    EditCase{"FollowingLight", {"rays", "southwell", true}},
                    EditCase{"UnderASky", {"rays", "chebyshev", false, std::size_t{1} << 30, true}},
                    EditCase{"WhiteRoom", {"rays", "jacobi", false, std::size_t{1} << 30, false, 0.95}},
                    EditCase{"Direct", {"rays", "direct"}}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(EditedSolves, WithoutALightAreDarkAtOnceAndComeBack) {
  const SolveCase c{"rays", "southwell"};
  auto solve = solved(roomToEdit(), optionsToEdit(c));
  solve = edited(*solve, [](auto& m) { m[kLight].emission = glm::dvec3(0.0); });
  EXPECT_EQ(solve->state(), SolveState::kConverged);
  EXPECT_EQ(solve->stoppedBy(), "no light");
  for (const glm::vec3& h : solve->snapshot().irradiance) ASSERT_EQ(h, glm::vec3(0.0f));
  solve = edited(*solve, [](auto& m) { m[kLight].emission = {5, 4, 3}; });
  EXPECT_EQ(solve->state(), SolveState::kRunning);
  expectAsAfresh(*solve, c);
}

TEST(EditedSolves, SayWhereNothingDiesOutAndRecover) {
  const SolveCase c{"rays", "southwell"};
  auto solve = solved(roomToEdit(), optionsToEdit(c));
  solve = edited(*solve, [](auto& m) {
    for (Material& material : m) material.reflectance = glm::dvec3(1.0);
  });
  run(*solve);
  ASSERT_EQ(solve->state(), SolveState::kFailed);
  EXPECT_NE(solve->stoppedBy().find("no finite solution"), std::string::npos) << solve->stoppedBy();
  solve = edited(*solve, [](auto& m) { m[kRed].reflectance = m[kBlack].reflectance = glm::dvec3(0.3); });
  expectAsAfresh(*solve, c);
}

TEST(EditedSolves, AreSavedAndGoOnWithTheirMaterials) {
  const SolveCase c{"rays", "southwell"};
  const TempFolder folder;
  auto solve = solved(roomToEdit(), optionsToEdit(c));
  solve = edited(*solve, [](auto& m) { m[kRed].reflectance = {0.1, 0.8, 0.1}; });
  run(*solve, 5);
  solve->save(folder.path() / "solve");
  const auto resume = [&] {
    return std::make_unique<Solve>(roomToEdit(), optionsToEdit(c), context, CancelToken{},
                                   readSavedSolve(folder.path() / "solve"));
  };
  auto next = resume();
  EXPECT_EQ(next->scene().materials[kRed].reflectance, glm::dvec3(0.1, 0.8, 0.1));
  EXPECT_EQ(next->snapshot().irradiance, solve->snapshot().irradiance);
  // Saved again it is still of the scene as it was read.
  next->save(folder.path() / "solve");
  next = resume();
  expectAsAfresh(*next, c);
}

TEST(EditedSolves, RefuseWhatIsNoMaterialAndStayAsTheyAre) {
  const SolveCase c{"rays", "southwell"};
  auto solve = solved(roomToEdit(), optionsToEdit(c));
  const std::vector<glm::vec3> before = solve->snapshot().irradiance;
  const double infinite = std::numeric_limits<double>::infinity(), none = std::nan("");
  for (const double value : {-0.1, 1.1, infinite, none}) {
    EXPECT_THROW(edited(*solve, [&](auto& m) { m[kRed].reflectance.y = value; }), Error) << value;
    if (value == 1.1) continue;
    EXPECT_THROW(edited(*solve, [&](auto& m) { m[kRed].emission.y = value; }), Error) << value;
  }
  EXPECT_THROW(edited(*solve, [](auto& m) { m.pop_back(); }), Error);
  EXPECT_EQ(solve->snapshot().irradiance, before);
  EXPECT_EQ(solve->state(), SolveState::kConverged);
}

// The inside of a closed block is dark and has no elements: what is to shine there takes another mesh.
TEST(EditedSolves, TakeAnotherMeshWhereLightBeginsInTheDark) {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(0.5)), block = b.material("block", glm::dvec3(0.5)),
             inside = b.material("inside", glm::dvec3(0.5)),
             light = b.material("light", glm::dvec3(0.3), {5, 4, 3});
  addBox(b, {white, white, white, white, white, white}, {0, 0, 0}, {1, 1, 1}, true);
  addBox(b, {block, block, block, block, block, block}, {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}, false);
  b.quad(inside, {0.3, 0.3, 0.3}, {0.2, 0, 0}, {0, 0, 0.2});
  b.quad(light, {0.7, 0.9, 0.7}, {0.2, 0, 0}, {0, 0, 0.2});
  const auto solve = solved(b.finish(), optionsToEdit(SolveCase{"rays", "southwell"}));
  const auto may = [&](std::size_t material) {
    std::vector<Material> materials = solve->scene().materials;
    materials[material].emission = glm::dvec3(1.0);
    return solve->canEdit(materials);
  };
  EXPECT_TRUE(may(white));  // its other sides see nothing
  EXPECT_TRUE(may(light));
  EXPECT_FALSE(may(inside));
  EXPECT_FALSE(may(block));  // which would light its inside too
  EXPECT_THROW(edited(*solve, [&](auto& m) { m[inside].emission.x = 1; }), Error);
}

}  // namespace
}  // namespace unshot
