#include "session/saved_solve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <new>

#include "support/solve_cases.h"
#include "support/solving.h"
#include "support/temp_folder.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// A closed room of two colours with three faces of a block in it and a light below the ceiling.
Scene roomToSave(double reflectance = 0.7) {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(reflectance)),
             red = b.material("red", reflectance * glm::dvec3(1, 0.2, 0.2)),
             light = b.material("light", glm::dvec3(0.3), {5, 4, 3});
  addBox(b, {red, white, white, white, red, white}, {0, 0, 0}, {1, 1, 1}, true);
  addBox(b, {white, kNone, kNone, white, white, kNone}, {0.2, 0, 0.2}, {0.3, 0.4, 0.3}, false);
  b.quad(light, {0.6, 0.9, 0.6}, {0.2, 0, 0}, {0, 0, 0.2});
  return b.finish();
}

SolveOptions optionsToSave(const SolveCase& c) { return optionsOf(c, 0.05); }

std::unique_ptr<Solve> resumed(Scene scene, SolveOptions options, const std::filesystem::path& file) {
  return std::make_unique<Solve>(
      std::move(scene), std::move(options), []() -> gl::Context& { return sharedContext(); }, CancelToken{},
      readSavedSolve(file));
}

double irradianceDifference(const Snapshot& a, const Snapshot& b) {
  return rmsDifference(a.irradiance, b.irradiance);
}

// Which patches need not shoot shows at the end alone.
std::vector<std::string> plannedKeys(const Solve& solve) {
  std::vector<std::string> out;
  for (const PlanDecision& decision : solve.plan()) {
    if (decision.key != plan_keys::kShooters) out.push_back(decision.key);
  }
  return out;
}

std::vector<std::uint32_t> idlePatches(const Solve& solve) {
  for (const PlanDecision& decision : solve.plan())
    if (decision.key == plan_keys::kShooters) return decision.patches;
  return {};
}

class Saved : public testing::TestWithParam<SolveCase> {};

// Left at a third and at two thirds of the way, and taken up again.
TEST_P(Saved, EndsAsIfItHadNotBeenInterrupted) {
  const SolveCase& c = GetParam();
  const SolveOptions options = optionsToSave(c);
  const TempFolder folder;
  const auto through = begun(roomToSave(c.white), options);
  const int steps = run(*through);
  ASSERT_EQ(through->state(), SolveState::kConverged);
  auto solve = begun(roomToSave(c.white), options);
  for (int part = 1; part <= 2; ++part) {
    run(*solve, steps / 3);
    ASSERT_EQ(solve->state(), SolveState::kRunning);
    const Measures before = solve->measures();
    if (c.method == "hemicube" && c.mode == "southwell" && part == 1) {
      EXPECT_GT(before.drafts, 0u);
    }
    const double energy_off = std::abs(solve->energy().residual());
    solve->save(folder.path() / "solve");
    const Snapshot left = solve->snapshot();
    SolveOptions asked;  // what is not in the file
    asked.error = options.error;
    asked.kept_bytes = options.kept_bytes;
    solve = resumed(roomToSave(c.white), asked, folder.path() / "solve");
    EXPECT_EQ(solve->measures().shots, before.shots);
    EXPECT_GE(solve->measures().seconds, before.seconds);
    EXPECT_EQ(solve->measures().unshot_fraction, before.unshot_fraction);
    EXPECT_EQ(solve->measures().drafts, before.drafts);
    EXPECT_EQ(solve->modeKey(), through->modeKey());
    EXPECT_EQ(solve->formFactorsKey(), through->formFactorsKey());
    EXPECT_EQ(plannedKeys(*solve), plannedKeys(*through));
    EXPECT_NEAR(solve->energy().residual(), energy_off, 1e-9 * solve->energy().emitted);
    // As it was left, to the last bit.
    EXPECT_EQ(solve->snapshot().irradiance, left.irradiance);
  }
  run(*solve);
  ASSERT_EQ(solve->state(), SolveState::kConverged) << solve->stoppedBy();
  const double bounds = through->measures().solverBound() + solve->measures().solverBound();
  EXPECT_LE(irradianceDifference(solve->snapshot(), through->snapshot()), bounds);
  // Form factors at hand are computed once (groups of drafts are looked at again).
  if (c.kept_bytes > 0) {
    EXPECT_LE(solve->measures().rows, through->measures().rows * 11 / 10 + 20);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Solves, Saved,
    testing::Values(SolveCase{"hemicube", "southwell"}, SolveCase{"hemicube", "gmres"},
                    SolveCase{"hemicube", "southwell", false, 0}, SolveCase{"hemicube-visibility", "jacobi"},
                    SolveCase{"rays", "conjugate-gradient"}, SolveCase{"rays", "southwell", true},
                    SolveCase{"rays", "chebyshev", false, std::size_t{1} << 30, true},
                    SolveCase{"rays", "jacobi", false, std::size_t{1} << 30, false, 0.95}),
    [](const auto& row) {
      return testName(row.param.method) + testName(row.param.mode) +
             (row.param.follows_light     ? "FollowingLight"
              : row.param.white > 0.9     ? "OfAWhiteRoom"
              : row.param.sky             ? "UnderASky"
              : row.param.kept_bytes == 0 ? "KeepingNothing"
                                          : "");
    });

TEST(SavedSolves, OfAConvergedSolveAreConvergedUntilMoreIsAskedFor) {
  const SolveCase c{"rays", "southwell", true};
  const TempFolder folder;
  const auto solve = solved(roomToSave(), optionsToSave(c));
  solve->save(folder.path() / "solve");
  const auto same = resumed(roomToSave(), optionsToSave(c), folder.path() / "solve");
  EXPECT_EQ(same->state(), SolveState::kConverged);
  EXPECT_EQ(same->stoppedBy(), solve->stoppedBy());
  EXPECT_EQ(same->snapshot().irradiance, solve->snapshot().irradiance);
  SolveOptions more = optionsToSave(c);
  more.error = optionsToSave(c).error / 10;
  const auto better = resumed(roomToSave(), more, folder.path() / "solve");
  ASSERT_EQ(better->state(), SolveState::kRunning);
  run(*better);
  EXPECT_EQ(better->state(), SolveState::kConverged);
  EXPECT_LE(better->measures().solverBound(), 0.4 * more.error);
}

TEST(SavedSolves, KnowWhichPatchesNeverShot) {
  const TempFolder folder;
  SolveOptions options;
  options.form_factors = "rays";
  options.error = 0.1;
  const auto solve = solved(blockOnFloor(0.4), options);
  ASSERT_FALSE(idlePatches(*solve).empty());
  solve->save(folder.path() / "solve");
  EXPECT_EQ(idlePatches(*resumed(blockOnFloor(0.4), options, folder.path() / "solve")), idlePatches(*solve));
}

TEST(SavedSolves, GoOnInAnotherModeWhereItIsAskedFor) {
  const TempFolder folder;
  const SolveCase c{"rays", "southwell"};
  const auto solve = begun(roomToSave(), optionsToSave(c));
  run(*solve, 50);
  solve->save(folder.path() / "solve");
  SolveOptions other = optionsToSave(c);
  other.mode = "gmres";
  const auto next = resumed(roomToSave(), other, folder.path() / "solve");
  run(*next);
  EXPECT_EQ(next->modeKey(), "gmres");
  EXPECT_EQ(next->state(), SolveState::kConverged);
}

// And for what error the mesh was made: that of the whole.
TEST(SavedSolves, KeepWhatThePlanWasNotToLeaveOut) {
  const TempFolder folder;
  SolveOptions options;
  options.form_factors = "rays";
  options.error = 0.1;
  options.do_anyway = {std::string(plan_keys::kTriangles)};
  const auto solve = begun(roomToSave(), options);
  ASSERT_TRUE(solve->mesh().for_error);
  run(*solve, 3);
  solve->save(folder.path() / "solve");
  SolveOptions other;
  other.do_anyway = {std::string(plan_keys::kOuterSides)};
  const auto next = resumed(roomToSave(), other, folder.path() / "solve");
  EXPECT_TRUE(next->mesh().for_error);
  for (const std::string_view key : {plan_keys::kTriangles, plan_keys::kOuterSides}) {
    EXPECT_FALSE(leavesOut(next->options().do_anyway, key)) << key;
    EXPECT_TRUE(std::none_of(next->plan().begin(), next->plan().end(), [&](const PlanDecision& d) {
      return d.key == key;
    })) << key;
  }
}

TEST(SavedSolves, CountLimitsFromWhereTheyGoOn) {
  const TempFolder folder;
  SolveOptions options = optionsToSave({"rays", "southwell"});
  options.max_shots = 30;
  const auto solve = begun(roomToSave(), options);
  run(*solve);
  EXPECT_EQ(solve->stoppedBy(), "max_shots");
  solve->save(folder.path() / "solve");
  const auto next = resumed(roomToSave(), options, folder.path() / "solve");
  EXPECT_EQ(next->state(), SolveState::kRunning);
  run(*next);
  EXPECT_EQ(next->stoppedBy(), "max_shots");
  EXPECT_EQ(next->measures().shots, 60u);
}

TEST(SavedSolves, AreOfOneSceneAlone) {
  const TempFolder folder;
  const SolveCase c{"rays", "southwell"};
  const auto solve = begun(roomToSave(), optionsToSave(c));
  run(*solve, 5);
  solve->save(folder.path() / "solve");
  Scene other = roomToSave();
  other.materials[0].reflectance.x += 1e-9;
  try {
    resumed(other, optionsToSave(c), folder.path() / "solve");
    FAIL() << "another scene was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_EQ(error.where(), (folder.path() / "solve").string());
  }
}

// Gives `left` columns and then throws what `failure` does.
class FailingMethod final : public FormFactorMethod {
 public:
  FailingMethod(std::unique_ptr<FormFactorMethod> method, int left, std::function<void()> failure)
      : method_(std::move(method)), left_(left), failure_(std::move(failure)) {}
  ReceiverKind receiverKind() const override { return method_->receiverKind(); }
  Column column(std::uint32_t q) override {
    if (left_-- <= 0) failure_();
    return method_->column(q);
  }
  Row row(std::uint32_t v) override { return method_->row(v); }

 private:
  std::unique_ptr<FormFactorMethod> method_;
  int left_;
  std::function<void()> failure_;
};

struct Failure {
  std::string_view name, mode;
  std::function<void()> raise;
  ErrorKind kind;
};

class StepThatThrows : public testing::TestWithParam<Failure> {};

// A driver that gives up, memory that is used up: what was shot before stands, can be saved, and goes on.
TEST_P(StepThatThrows, LeavesASolveThatCanBeSavedAndGoOn) {
  const Failure& failure = GetParam();
  const TempFolder folder;
  SolveCase c{"rays", failure.mode};
  SolveOptions options = optionsToSave(c);
  options.wrap_form_factors = [&](std::unique_ptr<FormFactorMethod> method) {
    return std::make_unique<FailingMethod>(std::move(method), 20, failure.raise);
  };
  const auto solve = begun(roomToSave(), options);
  run(*solve);
  ASSERT_EQ(solve->state(), SolveState::kFailed);
  EXPECT_EQ(solve->failure().value().kind(), failure.kind);
  EXPECT_FALSE(solve->failure()->advice().empty());
  EXPECT_GT(solve->measures().rows, 10u);
  EXPECT_NEAR(solve->energy().residual(), 0, 1e-9 * solve->energy().emitted);
  solve->save(folder.path() / "solve");
  const auto next = resumed(roomToSave(), optionsToSave(c), folder.path() / "solve");
  EXPECT_EQ(next->measures().shots, solve->measures().shots);
  run(*next);
  EXPECT_EQ(next->state(), SolveState::kConverged);
  const auto through = solved(roomToSave(), optionsToSave(c));
  EXPECT_LE(irradianceDifference(next->snapshot(), through->snapshot()),
            next->measures().solverBound() + through->measures().solverBound());
}

const Failure kFailures[] = {
    {"MemoryUsedUp", "southwell", [] { throw std::bad_alloc(); }, ErrorKind::kEnvironment},
    {"MemoryUsedUpInASweep", "jacobi", [] { throw std::bad_alloc(); }, ErrorKind::kEnvironment},
    {"MemoryUsedUpInAProduct", "gmres", [] { throw std::bad_alloc(); }, ErrorKind::kEnvironment},
    {"DriverGivesUp", "southwell",
     [] { throw Error(ErrorKind::kEnvironment, "OpenGL error GL_CONTEXT_LOST", {}, "another --gl"); },
     ErrorKind::kEnvironment},
};

INSTANTIATE_TEST_SUITE_P(Solves, StepThatThrows, testing::ValuesIn(kFailures),
                         [](const auto& row) { return std::string(row.param.name); });

// What is asked for the first time stays what it was where saving fails.
TEST(SavedSolves, LeaveTheFileBeforeWhereTheyCannotBeWritten) {
  const TempFolder folder;
  const auto solve = begun(roomToSave(), optionsToSave(SolveCase{"rays", "southwell"}));
  EXPECT_THROW(solve->save("/dev/full"), Error);
  EXPECT_THROW(solve->save(folder.path() / "missing" / "solve"), Error);
  solve->save(folder.path() / "solve");
  EXPECT_NO_THROW(readSavedSolve(folder.path() / "solve"));
}

}  // namespace
}  // namespace unshot
