// A session that draws hemicubes, with a context made on another thread.
#include <gtest/gtest.h>

#include <atomic>

#include "gl/context.h"
#include "scene/obj_reader.h"
#include "support/assets.h"
#include "support/session_watch.h"

namespace unshot {
namespace {

using namespace testing_support;

SolveOptions hemicubes(std::uint64_t elements, double error) {
  SolveOptions options;
  options.form_factors = "hemicube";
  options.elements = elements;
  options.error = error;
  options.hemicube_resolution = 64;
  return options;
}

TEST(SessionGl, SolvesWithHemicubesAndLeavesTheContextFree) {
  const auto context = gl::createContext("osmesa");
  const SolveOptions options = hemicubes(200, 0.02);
  Snapshot expected;
  {
    Solve plain(readObj(asset("cornell_box.obj")), options, [&]() -> gl::Context& { return *context; });
    while (plain.state() == SolveState::kRunning) plain.step(Solve::kMostAtOnce);
    expected = plain.snapshot();
  }
  context->release();

  SessionWatch watch(context.get());
  watch->open(asset("two_patches.obj"), hemicubes(60, 0.02));
  EXPECT_EQ(watch.rested()->phase, SessionPhase::kConverged);
  watch->open(asset("cornell_box.obj"), options);
  const StatePointer state = watch.rested();
  EXPECT_EQ(state->phase, SessionPhase::kConverged) << (state->problem ? state->problem->what() : "");
  EXPECT_EQ(state->facts->form_factors, "hemicube");
  EXPECT_GT(state->drawn, 0u);
  EXPECT_EQ(state->snapshot->irradiance, expected.irradiance);
  EXPECT_EQ(*state->snapshot->direct, *expected.direct);
  watch.close();
  checkPublications(watch.seen());

  context->makeCurrent();  // the solver thread has let go of it
  EXPECT_EQ(context->functions().GetError(), GLenum{GL_NO_ERROR});
}

// Each draft that is replaced brings unshot power of its own.
TEST(SessionGl, RefiningDraftsIsNoStagnation) {
  const auto context = gl::createContext("osmesa");
  SolveOptions options = hemicubes(1000, 1e-6);
  options.draft_first = true;
  Solve solve(readObj(asset("cornell_box.obj")), options, [&]() -> gl::Context& { return *context; });
  while (solve.state() == SolveState::kRunning) solve.step();
  EXPECT_EQ(solve.state(), SolveState::kConverged) << solve.stoppedBy();
  EXPECT_EQ(solve.measures().drafts, 0u);
}

TEST(SessionGl, ClosesWhileItLoadsAndWhileItShoots) {
  const auto context = gl::createContext("osmesa");
  for (std::uint64_t version = 0; version <= 5; ++version) {
    SessionWatch watch(context.get());
    watch->open(asset("two_patches.obj"), hemicubes(60, 1e-12));
    watch->open(asset("cornell_box.obj"), hemicubes(100, 1e-12));
    watch.wait("publication", [&](const SessionState& s) { return s.version >= version; });
    watch.close();
    checkPublications(watch.seen());
  }
}

// A driver that fails half way: one of its functions throws.
TEST(SessionGl, AStepThatThrowsKeepsTheLastSnapshot) {
  const auto context = gl::createContext("osmesa");
  SessionWatch watch(context.get());
  watch.openPaused(asset("two_patches.obj"), hemicubes(60, 1e-12));
  watch->step(2);
  const StatePointer before = watch.rested();
  // The solver thread waits for the next command: nothing else uses the table.
  auto& functions = const_cast<gl::Functions&>(context->functions());
  const auto read_pixels = functions.ReadPixels;
  functions.ReadPixels = [](GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*) {
    throw Error(ErrorKind::kEnvironment, "the driver is lost");
  };
  watch->resume();
  const StatePointer failed = watch.rested();
  EXPECT_EQ(failed->phase, SessionPhase::kFailed);
  EXPECT_EQ(failed->stopped_by, "the driver is lost");
  EXPECT_EQ(failed->problem.value().kind(), ErrorKind::kEnvironment);
  EXPECT_EQ(fingerprint(*failed->snapshot), fingerprint(*before->snapshot));
  watch->resume();
  watch->step(1);
  watch->setMode("jacobi");
  const StatePointer still = watch.rested();
  EXPECT_EQ(still->phase, SessionPhase::kFailed);
  EXPECT_EQ(still->problems, 2u);
  EXPECT_EQ(still->stopped_by, "the driver is lost");
  functions.ReadPixels = read_pixels;
  watch->restart(hemicubes(60, 0.02));
  EXPECT_EQ(watch.rested()->phase, SessionPhase::kConverged);
  watch.close();
  checkPublications(watch.seen());
}

}  // namespace
}  // namespace unshot
