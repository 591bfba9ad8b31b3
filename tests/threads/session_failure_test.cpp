// What a session keeps when a command or a solve fails.
#include <gtest/gtest.h>

#include "support/scenes.h"
#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

SolveOptions withBoth() {
  SolveOptions options = endless();
  options.element_size = 0.5;  // beside a number of elements
  return options;
}

SolveOptions withError(double error) {
  SolveOptions options = endless();
  options.error = error;
  return options;
}

SolveOptions withMode(const std::string& mode) {
  SolveOptions options = endless();
  options.mode = mode;
  return options;
}

SolveOptions hemicubes() {
  SolveOptions options = endless();
  options.form_factors = "hemicube";
  return options;
}

class SessionFailure : public testing::Test {
 protected:
  TempFolder folder_;
  const std::string broken_ = folder_.write("broken.obj", "v 0 0 0\nf 1 2 3\n");
  const std::string empty_ = folder_.write("empty.obj", "");
};

TEST_F(SessionFailure, OfTheFirstSceneLeavesTheSessionEmpty) {
  SessionWatch watch;
  for (const std::string& path : {folder_ / "missing.obj", broken_, empty_, folder_.path().string()}) {
    watch->open(path, endless());
    const StatePointer state = watch.carriedOut();
    EXPECT_EQ(state->phase, SessionPhase::kEmpty);
    EXPECT_EQ(state->problem.value().kind(), ErrorKind::kInput);
    EXPECT_FALSE(state->facts);
  }
  EXPECT_EQ(watch->latest()->problems, 4u);
  watch->open(asset("two_patches.obj"), closedForm(60, 0.01));
  const StatePointer state = watch.rested();
  EXPECT_EQ(state->phase, SessionPhase::kConverged);
  EXPECT_EQ(state->problems, 4u);
  watch.close();
  checkPublications(watch.seen());
}

TEST_F(SessionFailure, OfAnotherSceneOrRestartGoesOnAsBefore) {
  for (const bool paused : {false, true}) {
    SessionWatch watch;
    watch->open(asset("cornell_box.obj"), endless());
    if (paused) watch->pause();
    const StatePointer before = watch.carriedOut();
    const std::function<void()> failures[] = {
        [&] { watch->open(folder_ / "missing.obj", endless()); },
        [&] { watch->open(broken_, endless()); },
        [&] { watch->open(asset("two_patches.obj"), hemicubes()); },  // without OpenGL
        [&] { watch->open(asset("two_patches.obj"), withMode("no such mode")); },
        [&] { watch->restart(withError(std::nan(""))); },
        [&] { watch->restart(withMode("no such mode")); },
        [&] { watch->restart(withBoth()); },
        [&] { watch->restart(hemicubes()); },
    };
    std::uint64_t problems = 0;
    for (const auto& fail : failures) {
      fail();
      const StatePointer after = watch.carriedOut();
      EXPECT_EQ(after->problems, ++problems);
      EXPECT_EQ(after->phase, paused ? SessionPhase::kPaused : SessionPhase::kRunning);
      EXPECT_EQ(after->epoch, 1u);
      EXPECT_EQ(after->facts, before->facts);
      EXPECT_EQ(after->snapshot->mesh, before->snapshot->mesh);
    }
    const std::uint64_t shots = watch->latest()->measures.shots;
    watch->step(2);
    EXPECT_GE(watch.rested()->measures.shots, shots + 2);
    watch.close();
    checkPublications(watch.seen());
  }
}

TEST_F(SessionFailure, KeepsTheSceneBeforeUntilTheNextIsReady) {
  SessionWatch watch;
  watch->open(asset("two_patches.obj"), closedForm(60, 0.01));
  const StatePointer first = watch.rested();
  watch->open(asset("furnace.obj"), closedForm(24, 0.01));
  const StatePointer second = watch.rested();
  EXPECT_EQ(second->phase, SessionPhase::kConverged);
  EXPECT_EQ(second->epoch, 2u);
  EXPECT_NE(second->snapshot->mesh, first->snapshot->mesh);
  watch.close();
  int loading = 0;
  for (const auto& seen : watch.seen()) {
    if (seen.state->phase != SessionPhase::kLoading || seen.state->epoch != 1) continue;
    ++loading;
    EXPECT_EQ(seen.state->snapshot->mesh, first->snapshot->mesh);
    EXPECT_EQ(seen.state->facts, first->facts);
  }
  EXPECT_EQ(loading, 2);
  checkPublications(watch.seen());
}

// A room in which nothing absorbs: the unshot power never falls.
TEST_F(SessionFailure, OfASolveKeepsItsLastStateAndCanBeRestarted) {
  folder_.write("mirror.mtl", "newmtl white\nKd 1 1 1\nnewmtl light\nKd 1 1 1\nKe 1 1 1\n");
  std::string text = roomObj();
  text.replace(text.find("room.mtl"), 8, "mirror.mtl");
  SessionWatch watch;
  watch->open(folder_.write("mirror.obj", text), closedForm(6, 0.01));
  const StatePointer failed = watch.rested();
  ASSERT_EQ(failed->phase, SessionPhase::kFailed);
  EXPECT_EQ(failed->problems, 1u);
  EXPECT_NE(failed->stopped_by.find("no finite solution"), std::string::npos);
  EXPECT_GT(failed->snapshot->measures.shots, 0u);
  for (const glm::vec3& h : failed->snapshot->irradiance) ASSERT_TRUE(std::isfinite(h.x));
  watch->resume();
  watch->step(1);
  watch->pause();
  const StatePointer still = watch.carriedOut();
  EXPECT_EQ(still->phase, SessionPhase::kFailed);
  EXPECT_EQ(still->problems, 1u);
  watch->restart(closedForm(6, 0.5));
  watch.carriedOut();
  watch.close();
  for (const auto& seen : watch.seen()) {
    if (seen.state->task.empty() && seen.state->epoch == 2 && seen.state->measures.shots == 0) {
      EXPECT_EQ(seen.state->phase, SessionPhase::kRunning);
    }
  }
  EXPECT_EQ(watch.seen().back().state->epoch, 2u);
  checkPublications(watch.seen());
}

// Values beyond the range of double: the first shot is not finite.
TEST_F(SessionFailure, OfNumbersKeepsTheLastGoodSnapshot) {
  folder_.write("sun.mtl",
                "newmtl white\nKd 0.5 0.5 0.5\nnewmtl light\nKd 0.5 0.5 0.5\nKe 1e308 1e308 1e308\n");
  std::string text = roomObj();
  text.replace(text.find("room.mtl"), 8, "sun.mtl");
  SessionWatch watch;
  watch->open(folder_.write("sun.obj", text), closedForm(6, 0.01));
  const StatePointer state = watch.rested();
  EXPECT_EQ(state->phase, SessionPhase::kFailed);
  EXPECT_EQ(state->problems, 1u);
  EXPECT_EQ(state->progress, 0);
  EXPECT_EQ(state->snapshot->measures.shots, 0u);
}

TEST_F(SessionFailure, ASceneWithoutLightHasConvergedAtOnce) {
  SessionWatch watch;
  folder_.write("room.mtl", kMaterials);
  SolveOptions options = closedForm(24, 0.01);
  options.sky = glm::dvec3(0.0);
  watch->open(folder_.write("dark.obj", roomObj("white", "white")), options);
  const StatePointer state = watch.rested();
  EXPECT_EQ(state->phase, SessionPhase::kConverged);
  EXPECT_EQ(state->stopped_by, "no light");
  watch->setError(1e-6);
  EXPECT_EQ(watch.rested()->phase, SessionPhase::kConverged);
}

}  // namespace
}  // namespace unshot
