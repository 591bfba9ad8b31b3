// What each command of a session does.
#include "session/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solver/modes.h"
#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

TEST(Session, IsEmptyBeforeTheFirstScene) {
  SessionWatch watch;
  const StatePointer first = watch->latest();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->phase, SessionPhase::kEmpty);
  EXPECT_EQ(first->version, 0u);
  watch->pause();
  watch->resume();
  watch->step(3);
  const StatePointer idle = watch.carriedOut();
  EXPECT_EQ(idle->phase, SessionPhase::kEmpty);
  EXPECT_EQ(idle->problems, 0u);
  watch->setMode("jacobi");
  watch->setError(0.1);
  watch->restart({});
  const StatePointer state = watch.carriedOut();
  EXPECT_EQ(state->phase, SessionPhase::kEmpty);
  EXPECT_EQ(state->problems, 3u);
  EXPECT_EQ(state->problem.value().kind(), ErrorKind::kUsage);
  watch.close();
  checkPublications(watch.seen());
}

double meanRed(const SessionState& s) {
  double sum = 0;
  for (const glm::vec3& h : s.snapshot->irradiance) sum += static_cast<double>(h.x);
  return sum / static_cast<double>(s.snapshot->irradiance.size());
}

struct PlainCase {
  const char* scene;
  std::uint64_t elements;
  double error;
};

TEST(Session, ConvergesToWhatAPlainSolveFindsInEveryMode) {
  const PlainCase cases[] = {
      {"furnace.obj", 24, 1e-6}, {"two_patches.obj", 60, 1e-6}, {"cornell_box.obj", 150, 1e-3}};
  for (const PlainCase& c : cases) {
    for (const IterationModeRow& mode : iterationModes()) {
      const SolveOptions options = closedForm(c.elements, c.error, std::string(mode.info.key));
      const auto plain = plainSolve(asset(c.scene), options);
      SessionWatch watch;
      watch->open(asset(c.scene), options);
      const StatePointer state = watch.rested();
      ASSERT_EQ(state->phase, SessionPhase::kConverged) << c.scene << " " << mode.info.key;
      EXPECT_THAT(state->stopped_by, testing::StartsWith("solver_"));
      EXPECT_EQ(state->facts->mode, mode.info.key);
      EXPECT_EQ(state->measures.shots, plain->measures().shots);
      EXPECT_EQ(state->progress, 1);
      const Snapshot expected = plain->snapshot();
      EXPECT_LE(relativeDifference(state->snapshot->irradiance, expected.irradiance), 1e-12);
      EXPECT_LE(relativeDifference(*state->snapshot->direct, *expected.direct), 1e-12);
      EXPECT_EQ(state->history->size(), plain->history().size());
      watch.close();
      checkPublications(watch.seen());
    }
  }
}

// Bounces and row sums wait for all columns: the few that no shot has asked for are computed at rest,
// unasked.
TEST(Session, ComputesAtRestWhatFewColumnsAreMissing) {
  SolveOptions options = closedForm(600, 0.03);
  options.form_factors = "rays";
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), options);
  const StatePointer converged = watch.rested();
  ASSERT_EQ(converged->phase, SessionPhase::kConverged);
  const std::size_t missing = converged->snapshot->bounce_wait.columns;
  ASSERT_GT(missing, 0u) << "or this test shows nothing";
  ASSERT_LE(static_cast<double>(missing), 0.02 * static_cast<double>(converged->facts->patches));
  const StatePointer rested = watch.wait("no more work", [&](const SessionState& s) {
    return s.version > converged->version && !s.spareWork();
  });
  EXPECT_EQ(rested->snapshot->bounce_wait.columns, 0u);
  EXPECT_TRUE(rested->snapshot->row_sums);
  EXPECT_TRUE(rested->snapshot->bounces);
  EXPECT_EQ(rested->measures.shots, converged->measures.shots);
  watch.close();
  checkPublications(watch.seen());
}

/// The box on a mesh that follows the light, solved.
StatePointer openFollowing(SessionWatch& watch, double error) {
  SolveOptions options;
  options.form_factors = "rays";
  options.error = error;
  watch->setPublishInterval(0);
  watch->open(asset("cornell_box.obj"), options);
  return watch.rested();
}

// A smaller error asks for a finer mesh: the light before is shown until that has its own.
TEST(Session, RefinesTheMeshWhereASmallerErrorIsAskedFor) {
  SessionWatch watch;
  const StatePointer coarse = openFollowing(watch, 0.06);
  ASSERT_EQ(coarse->phase, SessionPhase::kConverged);
  watch->setError(0.02);
  const auto isFiner = [&](const SessionState& s) { return s.epoch > coarse->epoch; };
  const StatePointer finer = watch.wait("a finer mesh", isFiner);
  EXPECT_EQ(finer->phase, SessionPhase::kConverged);
  EXPECT_GT(finer->facts->elements, coarse->facts->elements);
  EXPECT_GT(finer->facts->patches, coarse->facts->patches);
  EXPECT_GT(finer->measures.shots, coarse->measures.shots);
  EXPECT_EQ(finer->facts->options.error, 0.02);
  // It can be edited as before.
  std::vector<Material> materials = finer->snapshot->mesh->materials;
  for (Material& m : materials) m.reflectance *= 0.5;
  watch->edit(materials);
  EXPECT_EQ(watch.rested()->snapshot->mesh->materials, materials);
  watch.close();
  checkPublications(watch.seen());
  bool refining = false;
  for (const auto& seen : watch.seen()) {
    const SessionState& s = *seen.state;
    if (!s.snapshot || s.measures.shots < coarse->measures.shots || s.commands > 2) continue;
    refining = refining || s.finer_mesh;
    EXPECT_GT(meanRed(s), 0.5 * meanRed(*coarse)) << "darkness between";
  }
  EXPECT_TRUE(refining);
}

// What is asked for meanwhile is for the solve that is shown.
TEST(Session, LeavesRefiningForWhatIsAskedMeanwhile) {
  SessionWatch watch;
  const StatePointer coarse = openFollowing(watch, 0.06);
  watch->setError(0.01);
  watch.wait("refining", [](const SessionState& s) { return s.finer_mesh; });
  watch->pause();
  EXPECT_EQ(watch.carriedOut()->phase, SessionPhase::kPaused);
  watch->resume();
  std::vector<Material> materials = coarse->snapshot->mesh->materials;
  for (Material& m : materials) m.reflectance *= 0.5;
  watch->edit(materials);
  const StatePointer finer =
      watch.wait("a finer mesh", [&](const SessionState& s) { return s.epoch > coarse->epoch; });
  EXPECT_EQ(finer->snapshot->mesh->materials, materials);
  watch->setError(0.005);
  watch.wait("refining again", [](const SessionState& s) { return s.finer_mesh; });
  watch->open(asset("furnace.obj"), closedForm(24, 1e-6));
  EXPECT_EQ(watch.rested()->facts->scene_name, "furnace");
  watch.close();
  checkPublications(watch.seen());
}

// Each round of looks is shown, the last is what a plain solve ends with, and materials can be edited then.
TEST(Session, GathersInRoundsThatAreShown) {
  SolveOptions options = closedForm(300, 0.02);
  options.final_gather = true;
  const auto plain = plainSolve(asset("cornell_box.obj"), options);
  SessionWatch watch;
  watch->setPublishInterval(0);
  watch->open(asset("cornell_box.obj"), options);
  const StatePointer state = watch.rested();
  ASSERT_EQ(state->phase, SessionPhase::kConverged);
  EXPECT_LE(relativeDifference(state->snapshot->irradiance, plain->snapshot().irradiance), 1e-12);
  watch.close();
  std::vector<std::vector<glm::vec3>> shown;
  for (const auto& seen : watch.seen()) {
    if (seen.state->activity != "gathering" && seen.state->phase != SessionPhase::kConverged) continue;
    if (shown.empty() || shown.back() != seen.state->snapshot->irradiance)
      shown.push_back(seen.state->snapshot->irradiance);
  }
  EXPECT_GE(shown.size(), 2u) << "what the solve had, and what was gathered";
  checkPublications(watch.seen());
}

TEST(Session, ShowsTheUnlitSceneAtOnceAndSaysWhatItLoads) {
  SessionWatch watch;
  watch->open(asset("two_patches.obj"), closedForm(60, 0.01));
  watch.rested();
  watch.close();
  const auto seen = watch.seen();
  ASSERT_GE(seen.size(), 4u);
  EXPECT_EQ(seen[0].state->task, "reading two_patches.obj");
  EXPECT_EQ(seen[1].state->task, "meshing two_patches.obj");
  EXPECT_EQ(seen[2].state->phase, SessionPhase::kRunning);
  EXPECT_EQ(seen[2].state->epoch, 1u);
  EXPECT_EQ(seen[2].state->snapshot->measures.shots, 0u);
  checkPublications(seen);
}

TEST(Session, APauseAfterOpenComesBeforeTheFirstShot) {
  SessionWatch watch;
  const StatePointer paused = watch.openPaused(asset("cornell_box.obj"), closedForm(150, 1e-3));
  EXPECT_EQ(paused->phase, SessionPhase::kPaused);
  EXPECT_EQ(paused->measures.shots, 0u);
  watch->resume();
  EXPECT_EQ(watch.rested()->phase, SessionPhase::kConverged);
  watch->pause();
  EXPECT_EQ(watch.carriedOut()->phase, SessionPhase::kConverged);
}

// However slow the sender is: commands sent while the session is held fall between the same two steps.
TEST(Session, AHoldLetsNoShotFallBetweenCommands) {
  SessionWatch watch;
  {
    const Session::Hold hold(*watch.operator->());
    watch->open(asset("cornell_box.obj"), endless());
    const StatePointer open = watch.carriedOut();
    EXPECT_EQ(open->phase, SessionPhase::kRunning);
    for (int k = 0; k < 20; ++k) {  // after each of them a session that is not held takes a step
      watch->setError(1e-300);
      EXPECT_EQ(watch.carriedOut()->measures.shots, 0u);
    }
    watch->pause();
    watch.carriedOut();
  }
  watch->step(3);
  EXPECT_EQ(watch.rested()->measures.shots, 3u);
}

TEST(Session, StepShootsAsManyAsAskedForAndPauses) {
  SessionWatch watch;
  watch.openPaused(asset("cornell_box.obj"), endless());
  std::uint64_t expected = 0;
  for (const std::uint64_t shots : {1, 0, 3, 17}) {
    watch->step(shots);
    expected += shots;
    const StatePointer state = watch.rested();
    EXPECT_EQ(state->phase, SessionPhase::kPaused);
    EXPECT_EQ(state->measures.shots, expected);
    EXPECT_EQ(state->snapshot->measures.shots, expected);
  }
  for (int k = 0; k < 5; ++k) watch->step(2);  // none is lost
  EXPECT_EQ(watch.rested()->measures.shots, expected + 10);
  watch.close();
  checkPublications(watch.seen());
}

TEST(Session, ClocksStandWhilePaused) {
  SessionWatch watch;
  watch.openPaused(asset("cornell_box.obj"), endless());
  watch->step(4);
  const double paused_at = watch.rested()->measures.seconds;
  SessionWatch other;  // takes its time
  other->open(asset("cornell_box.obj"), closedForm(150, 1e-2));
  other.rested();
  const double began = wallSeconds();
  watch->step(1);
  const StatePointer after = watch.rested();
  EXPECT_LE(after->measures.seconds - paused_at, wallSeconds() - began);
  EXPECT_EQ(after->measures.shots, 5u);
}

TEST(Session, SwitchesToEveryModeAndKeepsWhatWasShot) {
  const auto plain = plainSolve(asset("cornell_box.obj"), closedForm(150, 1e-8));
  const Snapshot expected = plain->snapshot();
  for (const IterationModeRow& mode : iterationModes()) {
    SessionWatch watch;
    watch.openPaused(asset("cornell_box.obj"), closedForm(150, 1e-8));
    watch->step(9);
    const StatePointer before = watch.rested();
    watch->setMode(std::string(mode.info.key));
    const StatePointer after = watch.carriedOut();
    EXPECT_EQ(after->facts->mode, mode.info.key);
    EXPECT_EQ(after->facts->options.mode, mode.info.key);
    EXPECT_EQ(after->phase, SessionPhase::kPaused);
    EXPECT_EQ(after->measures.shots, 9u);
    EXPECT_EQ(after->epoch, before->epoch);
    EXPECT_EQ(fingerprint(*after->snapshot), fingerprint(*before->snapshot));
    watch->resume();
    const StatePointer end = watch.rested();
    ASSERT_EQ(end->phase, SessionPhase::kConverged);
    // What is unshot, 1e-8 of the emitted power, may all lie on the smallest patches.
    EXPECT_LE(relativeDifference(end->snapshot->irradiance, expected.irradiance), 1e-5) << mode.info.key;
  }
}

TEST(Session, AnotherErrorRunsOnOrConverges) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), closedForm(150, 0.3));
  EXPECT_EQ(watch.rested()->phase, SessionPhase::kConverged);
  watch->setError(0.01);
  const StatePointer finer = watch.rested();
  EXPECT_EQ(finer->phase, SessionPhase::kConverged);
  EXPECT_LE(finer->measures.unshot_fraction, 0.01);
  EXPECT_EQ(finer->facts->options.error, 0.01);
  watch->setError(0.5);
  const StatePointer coarser = watch.rested();
  EXPECT_EQ(coarser->phase, SessionPhase::kConverged);
  EXPECT_EQ(coarser->measures.shots, finer->measures.shots);
  watch->setError(1e-300);
  watch->step(5);
  const StatePointer more = watch.rested();
  EXPECT_EQ(more->phase, SessionPhase::kPaused);
  watch->setError(0.5);
  EXPECT_EQ(watch.carriedOut()->phase, SessionPhase::kConverged);
  watch.close();
  checkPublications(watch.seen());
}

TEST(Session, AnImpossibleErrorOrModeChangesNothing) {
  SessionWatch watch;
  watch->open(asset("two_patches.obj"), closedForm(60, 0.125));
  EXPECT_EQ(watch.rested()->phase, SessionPhase::kConverged);
  std::uint64_t problems = 0;
  for (const double bad : {0.0, 1.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    watch->setError(bad);
    const StatePointer state = watch.carriedOut();
    EXPECT_EQ(state->problems, ++problems);
    EXPECT_EQ(state->problem.value().kind(), ErrorKind::kUsage);
    EXPECT_EQ(state->phase, SessionPhase::kConverged);
    EXPECT_EQ(state->facts->options.error, 0.125);
  }
  watch->setMode("no such mode");
  const StatePointer state = watch.carriedOut();
  EXPECT_EQ(state->problems, ++problems);
  EXPECT_EQ(state->facts->mode, "southwell");
}

TEST(Session, StopsAtALimitAndGoesOnOnlyAfterARestart) {
  SessionWatch watch;
  SolveOptions options = endless();
  options.max_shots = 7;
  watch->open(asset("cornell_box.obj"), options);
  const StatePointer stopped = watch.rested();
  EXPECT_EQ(stopped->phase, SessionPhase::kStopped);
  EXPECT_EQ(stopped->stopped_by, "max_shots");
  EXPECT_EQ(stopped->snapshot->measures.shots, 7u);
  watch->resume();
  watch->step(3);
  EXPECT_EQ(watch.rested()->measures.shots, 7u);
  options.max_shots = 9;
  watch->restart(options);
  const StatePointer again = watch.rested();
  EXPECT_EQ(again->epoch, 2u);
  EXPECT_EQ(again->measures.shots, 9u);
  watch.close();
  checkPublications(watch.seen());
}

TEST(Session, APublicationWaitsForItsInterval) {
  SessionWatch watch;
  watch->setPublishInterval(3600);
  watch.openPaused(asset("cornell_box.obj"), endless());
  const std::size_t before = watch.seen().size();
  watch->step(400);
  EXPECT_EQ(watch.rested()->measures.shots, 400u);
  EXPECT_EQ(watch.seen().size(), before + 2);  // the command, and the pause

  const double interval = 0.05;
  watch->setPublishInterval(interval);
  watch->resume();
  const std::uint64_t from = watch.carriedOut()->version;
  watch.wait("twelve more publications", [&](const SessionState& s) { return s.version >= from + 12; });
  watch.close();
  const auto seen = watch.seen();
  // The first of them may follow the command at once. The solve's clock was read at the step before each.
  const double took = seen[from + 10].state->measures.seconds - seen[from].state->measures.seconds;
  EXPECT_GE(took, 9 * interval);
}

TEST(Session, AnIntervalShorterThanTheEyeSeesIsNotTaken) {
  for (const double silly : {0.0, -1.0, std::nan(""), 1e-9}) {
    SessionWatch watch;
    watch->setPublishInterval(silly);
    watch->open(asset("furnace.obj"), endless(24));
    const double began = wallSeconds();
    watch->pause();
    watch->step(300);
    const StatePointer rested = watch.rested();            // estimates at rest are published as they come
    const double most = (wallSeconds() - began) * 30 + 8;  // commands, loading, changes of phase
    EXPECT_LE(static_cast<double>(rested->version), most);
  }
}

}  // namespace
}  // namespace unshot
