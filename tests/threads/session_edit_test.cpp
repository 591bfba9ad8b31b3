// Materials that are edited while a session solves.
#include <gtest/gtest.h>

#include <vector>

#include "threads/session_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

std::vector<Material> materialsOf(const SessionState& state) { return state.snapshot->mesh->materials; }

std::size_t lightOf(const std::vector<Material>& materials) {
  std::size_t m = 0;
  while (!materials.at(m).emits()) ++m;
  return m;
}

// What the same scene comes to from nothing.
Snapshot afresh(const SessionState& state, const SolveOptions& options) {
  auto solve = std::make_unique<Solve>(
      editedScene(readObj(state.facts->scene_path), materialsOf(state)), options,
      []() -> gl::Context& { throw Error(ErrorKind::kInternal, "closed forms do not draw"); });
  while (solve->state() == SolveState::kRunning) solve->step(Solve::kMostAtOnce);
  return solve->snapshot();
}

TEST(SessionEdit, GoesOnFromWhatWasShot) {
  const SolveOptions options = closedForm(150, 1e-4);
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), options);
  const StatePointer before = watch.rested();
  ASSERT_EQ(before->phase, SessionPhase::kConverged);
  std::vector<Material> materials = materialsOf(*before);
  materials[lightOf(materials)].emission *= glm::dvec3(0.5, 1, 2);
  watch->edit(materials);
  const StatePointer after = watch.rested();
  EXPECT_EQ(after->phase, SessionPhase::kConverged);
  EXPECT_EQ(after->epoch, before->epoch);
  EXPECT_GT(after->measures.shots, before->measures.shots);
  EXPECT_EQ(materialsOf(*after), materials);
  EXPECT_EQ(after->snapshot->mesh->cut, before->snapshot->mesh->cut);
  EXPECT_NE(materialsOf(*before), materials) << "a state changed after its publication";
  // Relative to the brightest vertex, beside which the error asked for is small.
  EXPECT_LE(relativeDifference(after->snapshot->irradiance, afresh(*after, options).irradiance), 1e-3);
  watch.close();
  checkPublications(watch.seen());
}

TEST(SessionEdit, ShowsAtOnceWhatIsPausedAndStaysPaused) {
  SessionWatch watch;
  watch.openPaused(asset("cornell_box.obj"), endless());
  watch->step(50);
  const StatePointer before = watch.rested();
  std::vector<Material> materials = materialsOf(*before);
  for (Material& m : materials) m.reflectance *= 0.5;
  watch->edit(materials);
  const StatePointer after = watch.carriedOut();
  EXPECT_EQ(after->phase, SessionPhase::kPaused);
  EXPECT_EQ(after->measures.shots, before->measures.shots);
  EXPECT_EQ(after->snapshot->irradiance, before->snapshot->irradiance);
  EXPECT_EQ(materialsOf(*after), materials);
}

TEST(SessionEdit, OfThoseThatWaitTheLastCounts) {
  SessionWatch watch;
  const StatePointer before = watch.openPaused(asset("cornell_box.obj"), endless());
  std::vector<Material> materials = materialsOf(*before);
  {
    const std::size_t published = watch.seen().size();
    // While one is carried out the others gather.
    for (int k = 1; k <= 50; ++k) {
      materials[0].reflectance.x = k / 50.0;
      watch->edit(materials);
    }
    const StatePointer after = watch.carriedOut();
    EXPECT_EQ(after->commands, watch->sent());
    EXPECT_EQ(materialsOf(*after), materials);
    EXPECT_LT(watch.seen().size() - published, 50u);
  }
  watch.close();
  checkPublications(watch.seen());
}

TEST(SessionEdit, ThatIsRefusedChangesNothing) {
  SessionWatch watch;
  watch->edit({});
  EXPECT_EQ(watch.carriedOut()->problem.value().kind(), ErrorKind::kUsage);
  const StatePointer before = watch.openPaused(asset("cornell_box.obj"), endless());
  std::vector<Material> materials = materialsOf(*before);
  materials[0].reflectance.x = 1.5;
  watch->edit(materials);
  const StatePointer after = watch.carriedOut();
  EXPECT_EQ(after->problems, before->problems + 1);
  EXPECT_EQ(after->phase, SessionPhase::kPaused);
  EXPECT_EQ(materialsOf(*after), materialsOf(*before));
}

TEST(SessionEdit, BeginsARaceAnew) {
  SessionWatch watch;
  watch->open(asset("cornell_box.obj"), closedForm(150, 1e-3));
  watch->race("jacobi");
  const StatePointer before = watch.rested();
  ASSERT_TRUE(before->rival);
  std::vector<Material> materials = materialsOf(*before);
  materials[0].reflectance *= 0.5;
  watch->edit(materials);
  const StatePointer after = watch.rested();
  EXPECT_GT(after->epoch, before->epoch);
  ASSERT_TRUE(after->rival);
  EXPECT_EQ(after->rival->snapshot->mesh->materials, materials);
  EXPECT_EQ(after->phase, SessionPhase::kConverged);
  watch.close();
  checkPublications(watch.seen());
}

TEST(SessionEdit, StaysWithARestartAndGoesWithTheFile) {
  SessionWatch watch;
  const SolveOptions options = closedForm(150, 1e-3);
  const StatePointer before = watch.openPaused(asset("cornell_box.obj"), options);
  std::vector<Material> materials = materialsOf(*before);
  materials[0].reflectance *= 0.5;
  watch->edit(materials);
  watch->restart(options);
  EXPECT_EQ(materialsOf(*watch.rested()), materials);
  watch->open(asset("cornell_box.obj"), options);
  EXPECT_EQ(materialsOf(*watch.rested()), materialsOf(*before));
}

}  // namespace
}  // namespace unshot
