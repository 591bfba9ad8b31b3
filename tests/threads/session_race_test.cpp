// Two solves of one session against each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

bool bothHaveSolvedFor(const SessionState& s, double seconds) {
  return s.rival && s.measures.seconds > seconds && s.rival->measures.seconds > seconds;
}

/// No step of the solve took longer, by its own clock [s], nor what comes before the first one, which the
/// first entry of its history counts; another entry is of one step or more.
double longestStep(const LaneState& lane) {
  const auto& history = *lane.history;
  double longest =
      std::max(history.front().measures.seconds, lane.measures.seconds - history.back().measures.seconds);
  for (std::size_t k = 1; k < history.size(); ++k)
    longest = std::max(longest, history[k].measures.seconds - history[k - 1].measures.seconds);
  return longest;
}

// Whoever is behind takes the next step, so neither is ever ahead by more than one step, or by what the other
// needed less to begin.
TEST(SessionRace, IsFairByTheSecondsOfEach) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), endless());
  watch->race("jacobi");
  watch.wait("both have solved", [](const SessionState& s) { return bothHaveSolvedFor(s, 0.3); });
  watch.close();
  const auto seen = watch.seen();
  const SessionState& last = *seen.back().state;
  const double most = std::max(longestStep(last), longestStep(*last.rival));
  std::size_t compared = 0;
  for (const SessionWatch::Seen& each : seen) {
    if (!each.state->rival || each.state->phase != SessionPhase::kRunning) continue;
    ++compared;
    EXPECT_LE(std::abs(each.state->measures.seconds - each.state->rival->measures.seconds), most + 1e-9);
  }
  EXPECT_GE(compared, 4u);
  checkPublications(seen);
}

TEST(SessionRace, EndsWhereEachAloneEnds) {
  const SolveOptions options = closedForm(150, 1e-3, "southwell");
  SolveOptions other = options;
  other.mode = "gauss-seidel";
  const auto first = plainSolve(asset("cornell_box.obj"), options),
             second = plainSolve(asset("cornell_box.obj"), other);
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), options);
  watch->race("gauss-seidel");
  const StatePointer end = watch.rested();
  ASSERT_EQ(end->phase, SessionPhase::kConverged);
  ASSERT_TRUE(end->rival);
  EXPECT_EQ(end->facts->mode, "southwell");
  EXPECT_EQ(end->rival->facts->mode, "gauss-seidel");
  EXPECT_EQ(end->measures.shots, first->measures().shots);
  EXPECT_EQ(end->rival->measures.shots, second->measures().shots);
  EXPECT_LE(relativeDifference(end->snapshot->irradiance, first->snapshot().irradiance), 1e-12);
  EXPECT_LE(relativeDifference(end->rival->snapshot->irradiance, second->snapshot().irradiance), 1e-12);
  EXPECT_EQ(end->snapshot->mesh, end->rival->snapshot->mesh);
  EXPECT_THAT(end->rival->stopped_by, testing::StartsWith("solver_"));
  watch.close();
  checkPublications(watch.seen());
}

TEST(SessionRace, StepsAndPausesBoth) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), endless());
  watch->race("overshoot");
  watch->pause();
  const StatePointer paused = watch.rested();
  ASSERT_EQ(paused->phase, SessionPhase::kPaused);
  const std::uint64_t before = paused->measures.shots, rival_before = paused->rival->measures.shots;
  watch->step(7);
  const StatePointer state = watch.rested();
  EXPECT_EQ(state->phase, SessionPhase::kPaused);
  EXPECT_EQ(state->measures.shots, before + 7);
  EXPECT_EQ(state->rival->measures.shots, rival_before + 7);
  EXPECT_EQ(state->rival->snapshot->measures.shots, rival_before + 7);
  watch.close();
  checkPublications(watch.seen());
}

TEST(SessionRace, WorksOutTheBouncesOfBoth) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), closedForm(100, 0.1));
  watch->race("jacobi");
  watch.rested();
  watch->completeBounces();
  watch.carriedOut();
  const StatePointer state = watch.wait(
      "bounces", [](const SessionState& s) { return s.phase == SessionPhase::kConverged && !s.spareWork(); });
  for (const LaneState* lane : {static_cast<const LaneState*>(state.get()), &*state->rival}) {
    ASSERT_TRUE(lane->snapshot->bounce_light);
    EXPECT_EQ(lane->snapshot->bounce_wait.columns, 0u);
    EXPECT_GT(lane->snapshot->bounce_light->received.size(), 2u);
  }
}

TEST(SessionRace, KeepsToTheMemoryThatIsAllowed) {
  SolveOptions options = endless();
  options.kept_bytes = 400'000;
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), options);
  watch->race("jacobi");
  const StatePointer state =
      watch.wait("both have solved", [](const SessionState& s) { return bothHaveSolvedFor(s, 0.3); });
  EXPECT_GT(state->kept_bytes, 0u);
  EXPECT_LE(state->kept_bytes + state->rival->kept_bytes, options.kept_bytes);
  EXPECT_EQ(state->facts->options.kept_bytes, options.kept_bytes) << "as asked for";
}

TEST(SessionRace, GoesOnUntilItIsEndedOrAnotherSceneOpens) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), closedForm(100, 1e-3));
  watch->race("jacobi");
  const auto modes = [](const SessionState& s) {
    return s.facts->mode + " against " + (s.rival ? s.rival->facts->mode : "nothing");
  };
  EXPECT_EQ(modes(*watch.rested()), "southwell against jacobi");
  const std::uint64_t epoch = watch->latest()->epoch;
  watch->setMode("gauss-seidel");
  StatePointer state = watch.rested();
  EXPECT_EQ(modes(*state), "gauss-seidel against jacobi");
  EXPECT_EQ(state->epoch, epoch + 1) << "both begin anew";
  watch->restart(closedForm(60, 1e-3));
  state = watch.rested();
  EXPECT_EQ(modes(*state), "southwell against jacobi");
  const std::uint64_t rows = state->measures.rows;
  EXPECT_GT(rows, 0u);
  watch->shootAgain();
  state = watch.rested();
  EXPECT_EQ(modes(*state), "southwell against jacobi");
  EXPECT_EQ(state->measures.rows, 0u) << "form factors are at hand";
  EXPECT_EQ(state->rival->measures.rows, 0u);
  watch->setError(1e-5);
  state = watch.rested();
  EXPECT_LE(state->measures.solverBound(), 1e-5);
  EXPECT_LE(state->rival->measures.solverBound(), 1e-5);
  const double light = state->snapshot->irradiance[0].x;
  watch->endRace();
  state = watch.rested();
  EXPECT_EQ(modes(*state), "southwell against nothing");
  EXPECT_EQ(state->snapshot->irradiance[0].x, light) << "the first stays as it was";
  watch->race("jacobi");
  watch->open(asset("two_patches.obj"), closedForm(60, 1e-3));
  EXPECT_EQ(modes(*watch.rested()), "southwell against nothing");
  watch.close();
  checkPublications(watch.seen());
}

TEST(SessionRace, ThatCannotBeginLeavesAllAsItWas) {
  SessionWatch watch;
  watch->race("jacobi");
  StatePointer state = watch.carriedOut();
  EXPECT_EQ(state->phase, SessionPhase::kEmpty);
  EXPECT_EQ(state->problem.value().kind(), ErrorKind::kUsage);
  watch->open(asset("cornell_box.obj"), closedForm(100, 1e-3));
  const StatePointer before = watch.rested();
  watch->race("no such mode");
  state = watch.carriedOut();
  EXPECT_EQ(state->problems, 2u);
  EXPECT_EQ(state->problem.value().kind(), ErrorKind::kUsage);
  EXPECT_EQ(state->epoch, before->epoch);
  EXPECT_EQ(state->phase, SessionPhase::kConverged);
  EXPECT_FALSE(state->rival);
}

}  // namespace
}  // namespace unshot
