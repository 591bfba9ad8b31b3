// The solve as an object: what may be changed while it runs, and the direct light in its snapshots. Form
// factors in closed form.
#include "session/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "session/publish_pace.h"
#include "solver/modes.h"
#include "support/assets.h"

namespace unshot {
namespace {

using testing_support::assetScene;

std::unique_ptr<Solve> begunInClosedForm(Scene scene, double error, const std::string& mode = "auto") {
  SolveOptions options;
  options.form_factors = "closed-form";
  options.elements = 120;
  options.error = error;
  options.mode = mode;
  return std::make_unique<Solve>(std::move(scene), options, []() -> gl::Context& {
    throw Error(ErrorKind::kInternal, "closed forms do not draw");
  });
}

void finish(Solve& solve) {
  while (solve.state() == SolveState::kRunning) solve.step();
}

TEST(Solve, ShootsAgainInEveryModeAndKnowsItsErrorAfterDirect) {
  const auto solve = begunInClosedForm(assetScene("two_patches.obj"), 1e-6, "direct");
  EXPECT_FALSE(solve->measures().true_error);
  finish(*solve);
  ASSERT_TRUE(solve->measures().true_error);
  EXPECT_LT(*solve->measures().true_error, 1e-12);
  for (const IterationModeRow& mode : iterationModes()) {
    SCOPED_TRACE(mode.info.key);
    solve->setMode(std::string(mode.info.key));
    solve->again();
    EXPECT_EQ(solve->measures().shots, 0u);
    EXPECT_EQ(solve->measures().unshot_fraction, 1);
    EXPECT_EQ(solve->history().size(), 1u);
    EXPECT_EQ(solve->snapshot().direct->front(), glm::vec3(0.0f));
    double most = 0;
    while (solve->state() == SolveState::kRunning) {
      solve->step();
      const Measures& m = solve->measures();
      ASSERT_TRUE(m.true_error);
      EXPECT_LE(*m.true_error, m.bounds.upper * (1 + 1e-6) + 1e-12);
      EXPECT_GE(*m.true_error * (1 + 1e-6) + 1e-12, m.bounds.lower);
      most = std::max(most, *m.true_error);
    }
    EXPECT_EQ(solve->state(), SolveState::kConverged);
    EXPECT_EQ(solve->measures().rows, 0u) << "form factors were at hand";
    EXPECT_LE(*solve->measures().true_error, 1e-6);
    EXPECT_GT(most, 1e-3) << "it began with nothing";
    EXPECT_LT(std::abs(solve->energy().residual()), 1e-9 * solve->energy().emitted);
  }
}

TEST(Solve, TakesTheSameShotsSeveralAtOnceAndNotOneTooMany) {
  constexpr std::uint64_t kShots = 1999;
  SolveOptions options;
  options.form_factors = "closed-form";
  options.elements = 120;
  options.error = 1e-300;
  options.max_shots = kShots;
  const auto end = [&](std::uint64_t most_shots, int& steps) {
    auto solve = std::make_unique<Solve>(assetScene("two_rooms.obj"), options, []() -> gl::Context& {
      throw Error(ErrorKind::kInternal, "closed forms do not draw");
    });
    for (steps = 0; solve->state() == SolveState::kRunning; ++steps) solve->step(most_shots);
    EXPECT_EQ(solve->stoppedBy(), "max_shots");
    EXPECT_EQ(solve->measures().shots, kShots);
    return solve;
  };
  int one_by_one = 0, at_once = 0;
  const auto single = end(1, one_by_one), several = end(Solve::kMostAtOnce, at_once);
  EXPECT_EQ(single->snapshot().irradiance, several->snapshot().irradiance);
  EXPECT_EQ(one_by_one, int{kShots});
  EXPECT_LT(at_once, one_by_one / 2);
}

TEST(Solve, ValidatesModeAndErrorAndKeepsThemWhereTheyAreBad) {
  const auto solve = begunInClosedForm(assetScene("two_patches.obj"), 0.25, "jacobi");
  EXPECT_THROW(solve->setMode("none"), Error);
  for (const double bad : {0.0, 1.0, -0.5, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(solve->setError(bad), Error);
  EXPECT_EQ(solve->modeKey(), "jacobi");
  EXPECT_EQ(solve->options().error, 0.25);
  solve->setMode("auto");
  EXPECT_EQ(solve->modeKey(), "southwell");
  EXPECT_EQ(solve->options().mode, "auto");
}

TEST(Solve, RunsAgainForASmallerErrorAndEndsForALargerOne) {
  const auto solve = begunInClosedForm(assetScene("furnace.obj"), 0.3);
  finish(*solve);
  ASSERT_EQ(solve->state(), SolveState::kConverged);
  const Measures first = solve->measures();
  solve->setError(first.solverBound());
  EXPECT_EQ(solve->state(), SolveState::kConverged);
  solve->setError(first.solverBound() / 8);
  EXPECT_EQ(solve->state(), SolveState::kRunning);
  EXPECT_EQ(solve->stoppedBy(), "");
  EXPECT_LT(solve->progress(), 1);
  solve->step();
  EXPECT_EQ(solve->measures().shots, first.shots + 1);
  solve->setError(0.9);
  EXPECT_EQ(solve->state(), SolveState::kConverged);
  EXPECT_THAT(solve->stoppedBy(), testing::StartsWith("solver_"));
  EXPECT_EQ(solve->history().back().measures.shots, first.shots + 1);
}

TEST(Solve, AnEndedSolveIsNotRevivedByAMode) {
  const auto solve = begunInClosedForm(assetScene("two_patches.obj"), 0.1);
  solve->interrupt();
  solve->setMode("jacobi");
  solve->setError(1e-6);
  solve->step();
  EXPECT_EQ(solve->state(), SolveState::kInterrupted);
  EXPECT_EQ(solve->measures().shots, 0u);
}

TEST(Solve, LightBeyondTheRangeOfNumbersFails) {
  Scene scene = assetScene("two_patches.obj");
  for (Material& m : scene.materials) m.emission *= 1e307;
  const auto solve = begunInClosedForm(std::move(scene), 0.01);
  solve->step();
  EXPECT_EQ(solve->state(), SolveState::kFailed);
  EXPECT_EQ(solve->progress(), 0);
  ASSERT_TRUE(solve->failure());
  EXPECT_EQ(solve->failure()->kind(), ErrorKind::kInternal);
  EXPECT_EQ(solve->stoppedBy(), "a value is no longer finite");
}

TEST(Solve, ARoomThatReflectsAllIsAnInputError) {
  Scene scene = assetScene("furnace.obj");
  for (Material& m : scene.materials) m.reflectance = glm::dvec3(1.0);
  const auto solve = begunInClosedForm(std::move(scene), 0.01);
  EXPECT_FALSE(solve->failure());
  finish(*solve);
  EXPECT_EQ(solve->state(), SolveState::kFailed);
  ASSERT_TRUE(solve->failure());
  EXPECT_EQ(solve->failure()->kind(), ErrorKind::kInput);
  EXPECT_NE(solve->stoppedBy().find("no finite solution"), std::string::npos);
}

// What the same scene receives where it is black: H = K E. Both are sums of the same products in double,
// rounded to float.
TEST(Solve, DirectLightIsWhatTheBlackSceneReceivesInEveryModeAndAfterSwitches) {
  for (const char* name : {"two_patches.obj", "furnace.obj", "cornell_box.obj"}) {
    Scene black = assetScene(name);
    for (Material& m : black.materials) m.reflectance = glm::dvec3(0.0);
    const auto reference = begunInClosedForm(std::move(black), 1e-9);
    finish(*reference);
    const Snapshot expected = reference->snapshot();
    for (const IterationModeRow& mode : iterationModes()) {
      for (const IterationModeRow& later : iterationModes()) {
        const auto solve = begunInClosedForm(assetScene(name), 1e-4, std::string(mode.info.key));
        for (int k = 0; k < 5; ++k) solve->step();
        solve->setMode(std::string(later.info.key));
        finish(*solve);
        const Snapshot got = solve->snapshot();
        ASSERT_EQ(got.direct->size(), expected.irradiance.size());
        for (std::size_t v = 0; v < got.direct->size(); ++v) {
          for (int c = 0; c < 3; ++c) {
            const float all = expected.irradiance[v][c];
            ASSERT_NEAR((*got.direct)[v][c], all, 2e-7f * all) << name << " " << mode.info.key;
            ASSERT_LE((*got.direct)[v][c], got.irradiance[v][c] * (1 + 2e-7f));
          }
        }
        for (std::size_t e = 0; e < got.element_direct->size(); ++e)
          ASSERT_NEAR((*got.element_direct)[e].y, expected.element_irradiance[e].y,
                      2e-7f * expected.element_irradiance[e].y);
      }
    }
  }
}

TEST(Solve, SnapshotsShareDirectLightThatDoesNotChange) {
  const auto solve = begunInClosedForm(assetScene("cornell_box.obj"), 1e-6);
  const Snapshot unlit = solve->snapshot();
  for (const glm::vec3& h : *unlit.direct) ASSERT_EQ(h, glm::vec3(0.0f));
  while (solve->measures().unshot_fraction > 0.3) solve->step();
  const Snapshot some = solve->snapshot();
  EXPECT_NE(some.direct, unlit.direct);
  solve->step();
  const Snapshot more = solve->snapshot();
  EXPECT_EQ(more.direct, some.direct);
  EXPECT_EQ(more.element_direct, some.element_direct);
  EXPECT_NE(more.irradiance, some.irradiance);
}

TEST(PublishPace, KeepsTheIntervalAndATenthOfTheTime) {
  PublishPace pace;
  EXPECT_TRUE(pace.due(0, PublishPace::kLeastInterval));
  pace.made(100, 100.001);
  EXPECT_FALSE(pace.due(100.03, PublishPace::kLeastInterval));
  EXPECT_TRUE(pace.due(100.035, PublishPace::kLeastInterval));
  EXPECT_FALSE(pace.due(100.035, 0.5));
  EXPECT_TRUE(pace.due(100.502, 0.5));
  pace.made(200, 200.25);
  EXPECT_FALSE(pace.due(202.7, 0.5));
  EXPECT_TRUE(pace.due(202.751, 0.5));
  for (const double silly : {0.0, -1.0, std::nan(""), 1e-9})
    EXPECT_EQ(PublishPace::interval(silly), PublishPace::kLeastInterval);
  EXPECT_EQ(PublishPace::interval(2), 2);
}

// Twice what the column says, of light that is neither escaped nor lost.
class DoublingMethod final : public FormFactorMethod {
 public:
  explicit DoublingMethod(std::unique_ptr<FormFactorMethod> method) : method_(std::move(method)) {}
  ReceiverKind receiverKind() const override { return method_->receiverKind(); }
  Column column(std::uint32_t q) override {
    Column out = method_->column(q);
    for (float& k : out.k) k *= 2;
    return out;
  }
  Row row(std::uint32_t v) override { return method_->row(v); }

 private:
  std::unique_ptr<FormFactorMethod> method_;
};

TEST(Solve, StopsWhereEnergyIsNotConserved) {
  SolveOptions options;
  options.form_factors = "closed-form";
  options.elements = 120;
  options.wrap_form_factors = [](std::unique_ptr<FormFactorMethod> method) {
    return std::make_unique<DoublingMethod>(std::move(method));
  };
  Solve solve(assetScene("two_patches.obj"), options,
              []() -> gl::Context& { throw Error(ErrorKind::kInternal, "closed forms do not draw"); });
  finish(solve);
  ASSERT_EQ(solve.state(), SolveState::kFailed);
  EXPECT_EQ(solve.failure().value().kind(), ErrorKind::kInternal);
  EXPECT_THAT(solve.failure()->what(), testing::HasSubstr("energy is not conserved"));
}

}  // namespace
}  // namespace unshot
