// Loading that is given up: closing at any moment of it, and another command that makes it vain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <thread>

#include "mesh/build.h"
#include "session/saved_solve.h"
#include "support/dice.h"
#include "support/landscape.h"
#include "support/sanitized.h"
#include "support/temp_folder.h"
#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Sanitizers make loading fifty times slower.
constexpr int kSquares = kSanitized ? 80 : 250;

class SessionGivingUp : public testing::Test {
 protected:
  SessionGivingUp() { folder_.write("land.mtl", kLandscapeMaterials); }

  double loadSeconds() const {
    const double began = wallSeconds();
    const Solve solve(readObj(scene_), options_, nullptr);
    return wallSeconds() - began;
  }
  /// What ends at once takes a small part of the loading; other work may hold it up [s].
  static double soon(double load_seconds) { return 0.25 * load_seconds + 0.3; }

  TempFolder folder_;
  const std::string scene_ = folder_.write("land.obj", landscape(kSquares));
  const SolveOptions options_ = endless(5000);
};

TEST_F(SessionGivingUp, ClosesSoonAtAnyMomentOfLoading) {
  const double load_seconds = loadSeconds();
  Dice dice(1);
  for (int k = 0; k < 5; ++k) {
    double least = INFINITY;
    std::string task;
    // What else the machine does can hold up one closing; one that is slow by itself is slow each time.
    for (int round = 0; round < 3 && least > soon(load_seconds); ++round) {
      SessionWatch watch;
      watch->open(scene_, options_);
      const double moment = wallSeconds() + (k + dice.uniform()) / 5 * load_seconds;
      while (wallSeconds() < moment) std::this_thread::yield();
      const StatePointer state = watch->latest();
      const double asked = wallSeconds();
      watch.close();
      least = std::min(least, wallSeconds() - asked);
      task = state->task;
      EXPECT_EQ(state->problems, 0u);
      checkPublications(watch.seen());
    }
    EXPECT_LT(least, soon(load_seconds)) << "while " << task;
  }
}

TEST_F(SessionGivingUp, ALaterSceneIsShownInsteadAndSoon) {
  const double load_seconds = loadSeconds();
  for (const char* task : {"reading", "meshing"}) {
    SessionWatch watch;
    watch->open(asset("two_patches.obj"), closedForm(60, 0.01));
    const StatePointer before = watch.rested();
    watch->open(scene_, options_);
    watch.wait(task, [&](const SessionState& s) { return s.task.starts_with(task); });
    const double asked = wallSeconds();
    watch->open(asset("cornell_box.obj"), endless(100));
    const StatePointer after =
        watch.wait("another scene", [&](const SessionState& s) { return s.epoch > before->epoch; });
    EXPECT_LT(wallSeconds() - asked, soon(load_seconds)) << "while " << task;
    EXPECT_EQ(after->facts->scene_name, "cornell_box");
    watch.close();
    for (const SessionWatch::Seen& seen : watch.seen()) {
      EXPECT_EQ(seen.state->problems, 0u);
      if (seen.state->facts) {
        EXPECT_NE(seen.state->facts->scene_name, "land");
      }
    }
    checkPublications(watch.seen());
  }
}

TEST_F(SessionGivingUp, ALaterSceneThatFailsLeavesTheOneBefore) {
  SessionWatch watch;
  watch->open(asset("two_patches.obj"), closedForm(60, 0.01));
  const StatePointer before = watch.rested();
  watch->open(scene_, options_);
  watch->open(folder_ / "missing.obj", options_);
  const StatePointer after = watch.rested();
  EXPECT_EQ(after->epoch, before->epoch);
  EXPECT_EQ(after->snapshot->mesh, before->snapshot->mesh);
  EXPECT_EQ(after->phase, SessionPhase::kConverged);
  EXPECT_EQ(after->problems, 1u);
}

TEST_F(SessionGivingUp, WhenAskedToTheSceneBeforeGoesOn) {
  const double load_seconds = loadSeconds();
  for (const bool reading : {true, false}) {
    SessionWatch watch;
    watch->open(asset("cornell_box.obj"), endless(60));
    const StatePointer before = watch.carriedOut();
    watch->open(scene_, options_);
    watch.wait("loading",
               [&](const SessionState& s) { return s.task.starts_with(reading ? "reading" : "meshing"); });
    const double asked = wallSeconds();
    watch->giveUpLoading();
    const StatePointer after = watch.wait("more shots", [&](const SessionState& s) {
      return s.phase == SessionPhase::kRunning && s.measures.shots > before->measures.shots;
    });
    EXPECT_LT(wallSeconds() - asked, soon(load_seconds));
    EXPECT_EQ(after->epoch, before->epoch);
    EXPECT_EQ(after->facts->scene_name, "cornell_box");
    EXPECT_EQ(after->problems, 0u);
  }
  SessionWatch watch;
  watch->giveUpLoading();  // of nothing
  watch->open(scene_, options_);
  watch.wait("loading", [&](const SessionState& s) { return !s.task.empty(); });
  watch->giveUpLoading();
  EXPECT_EQ(watch.wait("the end of it", [](const SessionState& s) { return s.commands == 1; })->phase,
            SessionPhase::kEmpty);
}

// At any moment of it: the file is whole or not there, and the solve goes on.
TEST_F(SessionGivingUp, ASaveLeavesAWholeFileOrNone) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), endless(2000));
  watch.carriedOut();
  Dice dice(2);
  const std::set<std::string> others = folder_.names();
  for (int k = 0; k < 20; ++k) {
    const std::uint64_t saves = watch->latest()->saves;
    watch->save(folder_ / "s.unshot");
    const double moment = wallSeconds() + 0.02 * dice.uniform();
    while (wallSeconds() < moment) std::this_thread::yield();
    watch->giveUpSaving();
    const StatePointer after = watch.carriedOut();
    EXPECT_EQ(after->problems, 0u);
    EXPECT_FALSE(after->saving);
    EXPECT_EQ(folder_.has("s.unshot"), after->saves > saves);
    if (!folder_.has("s.unshot")) continue;
    EXPECT_GT(readSavedSolve(folder_ / "s.unshot")->quality.size(), 0u);
    std::filesystem::remove(folder_ / "s.unshot");
  }
  EXPECT_EQ(folder_.names(), others);
  const std::uint64_t shots = watch->latest()->measures.shots;
  watch.wait("more shots", [&](const SessionState& s) { return s.measures.shots > shots; });
}

TEST_F(SessionGivingUp, OfSeveralRestartsTheLastCounts) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), endless(60));
  const StatePointer before = watch.carriedOut();
  watch->restart(endless(300'000));
  watch->restart(endless(400'000));
  watch->restart(endless(120));
  const StatePointer after = watch.carriedOut();
  EXPECT_EQ(after->epoch, before->epoch + 1);
  EXPECT_EQ(after->facts->options.elements, 120u);
  EXPECT_EQ(after->problems, 0u);
}

// A restart means the scene that is being opened, which therefore is not given up.
TEST_F(SessionGivingUp, ARestartWaitsForTheSceneBeforeIt) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), endless(60));
  watch->open(asset("two_patches.obj"), endless(60));
  watch->restart(endless(120));
  const StatePointer after = watch.carriedOut();
  EXPECT_EQ(after->facts->scene_name, "two_patches");
  EXPECT_EQ(after->facts->options.elements, 120u);
}

TEST_F(SessionGivingUp, ReadingAndMeshingThrowWhereTheyAreAskedTo) {
  std::atomic<bool> flag = true;
  const CancelToken token(flag);
  EXPECT_THROW(readObj(scene_, token), Cancelled);
  const Scene scene = readObj(asset("cornell_box.obj"));
  EXPECT_THROW(buildMesh(scene, {}, token), Cancelled);
  EXPECT_THROW(Solve(scene, options_, nullptr, token), Cancelled);
  flag = false;
  EXPECT_EQ(readObj(asset("cornell_box.obj"), token).triangle_count, scene.triangle_count);
  EXPECT_GT(buildMesh(scene, {}, token).element_count, 0u);
}

}  // namespace
}  // namespace unshot
