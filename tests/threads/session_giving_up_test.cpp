// Loading that is given up: closing at any moment of it, and another command that makes it vain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "mesh/build.h"
#include "support/dice.h"
#include "support/sanitized.h"
#include "support/temp_folder.h"
#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Sanitizers make loading fifty times slower.
constexpr int kSquares = kSanitized ? 80 : 250;

/// A wavy ground of 2 n^2 triangles under a lamp.
std::string landscape(int n) {
  std::string text = "mtllib land.mtl\nusemtl ground\n";
  const auto number = [](double x) { return " " + std::to_string(x); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = 10.0 * i / n, z = 10.0 * j / n;
      text += "v" + number(x) + number(std::sin(3 * x) * std::cos(2 * z)) + number(z) + "\n";
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::string a = " " + std::to_string(j * (n + 1) + i + 1),
                        b = " " + std::to_string(j * (n + 1) + i + 2),
                        c = " " + std::to_string((j + 1) * (n + 1) + i + 1),
                        d = " " + std::to_string((j + 1) * (n + 1) + i + 2);
      text.append("f").append(a).append(c).append(b).append("\nf").append(b).append(c).append(d).append("\n");
    }
  }
  return text + "v 4 3 4\nv 6 3 4\nv 6 3 6\nv 4 3 6\nusemtl lamp\nf -4 -3 -2 -1\n";
}

class SessionGivingUp : public testing::Test {
 protected:
  SessionGivingUp() {
    folder_.write("land.mtl", "newmtl ground\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n");
  }

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
