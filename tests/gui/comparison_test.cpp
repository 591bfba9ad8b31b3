// Bounces and differences in the viewer: chosen, waited for, compared.
#include "viewer/comparison.h"

#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "export/ply.h"
#include "support/live_viewer.h"
#include "support/temp_folder.h"
#include "viewer/panels/bounce_panel.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing_support::LiveViewer;
using testing_support::TempFolder;

LiveViewer::Options boxToCompare(const std::string& script = {}) {
  LiveViewer::Options options;
  options.scene = std::string(UNSHOT_SOURCE_DIR) + "/assets/cornell_box.obj";
  options.solve.elements = 300;
  options.solve.error = 0.1;  // so that some form factors are not wanted by then
  options.script = script;
  return options;
}

const Snapshot& shown(LiveViewer& live) { return *live->state().snapshot; }

TEST(Comparison, AScriptWaitsForTheBouncesItChose) {
  const TempFolder folder;
  const std::string png = folder / "two.png";
  LiveViewer live(boxToCompare("wait converged\nbounces 2\nscreenshot " + png + "\nremember\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  EXPECT_EQ(live->exitCode(), 0);
  EXPECT_EQ(shownBounces(shown(live), live->ui().settings.view.light), 2u);
  EXPECT_EQ(bounceWaitText(live->state()), "");
  const auto& reference = live->ui().settings.view.reference;
  ASSERT_TRUE(reference);
  EXPECT_EQ(reference->name, "up to 2 bounces");
  const ReferenceLight all = referenceLight(shown(live), {}, "all"),
                       direct = referenceLight(shown(live), {false, {}, false}, "direct");
  EXPECT_GT(reference->mean, direct.mean);
  EXPECT_LT(reference->mean, all.mean);
}

TEST(Comparison, ABounceByItself) {
  LiveViewer live(boxToCompare("wait converged\nbounce-alone 2\nremember\nbounces 2\n"));
  ASSERT_TRUE(live.until([&] { return live->scriptDone(); }));
  const ViewOptions& view = live->ui().settings.view;
  EXPECT_EQ(view.reference->name, "bounce 2 alone");
  EXPECT_FALSE(view.light.oneBounce()) << "bounces N is up to N";
  EXPECT_EQ(shownBounces(shown(live), view.light), 2u);
  const ReferenceLight both = referenceLight(shown(live), {true, 2, false}, "both"),
                       first = referenceLight(shown(live), {true, 1, false}, "first");
  EXPECT_NEAR(view.reference->mean, both.mean - first.mean, 1e-5 * both.mean);
  EXPECT_GT(view.reference->mean, 0.01 * both.mean);
  live->perform("bounce-alone", "all");
  EXPECT_TRUE(view.light.all());
  live->perform("bounce-alone", "0");
  ASSERT_TRUE(live->error());
  EXPECT_TRUE(view.light.all());
}

TEST(Comparison, TheFirstBounceIsDirectLight) {
  LiveViewer live(boxToCompare("wait converged\nbounces 1\n"));
  ASSERT_TRUE(live.until([&] {
    return live->state().snapshot && shownBounces(shown(live), live->ui().settings.view.light) == 1;
  }));
  const Snapshot& snapshot = shown(live);
  const std::vector<glm::vec3>& one = snapshot.bounce_light->received[0]->vertices;
  ASSERT_EQ(one.size(), snapshot.direct->size());
  for (std::size_t v = 0; v < one.size(); ++v) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(one[v][c], (*snapshot.direct)[v][c], 1e-5f * (1 + one[v][c]));
  }
}

TEST(Comparison, WhatIsMissingIsSaidAndComputedOnlyWhenAsked) {
  LiveViewer::Options options = boxToCompare();
  options.solve.error = 0.2;  // more than a few are missing, which would be computed without asking
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  ASSERT_GT(shown(live).bounce_wait.columns, 0u);
  EXPECT_EQ(shown(live).bounce_light, nullptr);
  EXPECT_THAT(bounceWaitText(live->state()), HasSubstr("columns of form factors are missing"));
  const std::uint64_t rows = live->state().measures.rows;
  live->perform("complete-bounces");
  ASSERT_TRUE(live.until([&] { return shown(live).bounce_light && !live->state().bounces_under_way; }));
  EXPECT_EQ(shown(live).bounce_wait.columns, 0u);
  EXPECT_GT(live->state().measures.rows, rows);
  const std::vector<glm::dvec3>& power = shown(live).bounce_light->power;
  ASSERT_GT(power.size(), 6u);
  for (std::size_t k = 1; k < power.size(); ++k) EXPECT_LT(bounceRatio(power, k), 1);
  EXPECT_THAT(bounceText(power, 3), HasSubstr("Bounce 3, B_3 = M\u00b3 E: "));
}

TEST(Comparison, MoreBouncesThanAreKnownAreSaid) {
  LiveViewer live(boxToCompare("wait converged\nbounces 1\n"));
  ASSERT_TRUE(live.until([&] {
    const auto& snapshot = live->state().snapshot;
    return live->scriptDone() && snapshot && snapshot->bounce_light && !live->state().bounces_under_way;
  }));
  const std::string known = std::to_string(shown(live).bounce_light->received.size());
  ViewOptions view;
  view.light = {true, 100000, true};
  EXPECT_THAT(differenceTitle(live->state(), view),
              testing::StartsWith("bounce " + known + " alone; bounce 100,000 is not known "));
  view.light.alone = false;
  EXPECT_THAT(differenceTitle(live->state(), view),
              testing::StartsWith("up to " + known + " bounces; more are not known "));
}

TEST(Comparison, ComputingWhatIsMissingCanBeGivenUp) {
  LiveViewer::Options options = boxToCompare();
  options.solve.elements = 10000;
  options.solve.form_factors = "rays";
  options.solve.max_shots = 20;
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kStopped));
  ASSERT_TRUE(live.until([&] { return live->nextFrame(0) > 1e30; }));
  const std::size_t missing = shown(live).bounce_wait.columns;
  ASSERT_GT(missing, 100u);
  live->perform("complete-bounces");
  const auto computes = [&] {
    const std::vector<Task> tasks = live->tasks();
    return !tasks.empty() && tasks.front().text.starts_with("computing") && *tasks.front().done > 0;
  };
  ASSERT_TRUE(live.until(computes));
  EXPECT_LT(*live->tasks().front().done, 1);
  live->perform("give-up");
  ASSERT_TRUE(live.until([&] { return live->tasks().empty() && live->nextFrame(0) > 1e30; }));
  EXPECT_FALSE(live->state().bounces_under_way);
  EXPECT_GT(shown(live).bounce_wait.columns, 0u);
  EXPECT_LT(shown(live).bounce_wait.columns, missing) << "what was computed is lost";
}

TEST(Comparison, ASolutionFromAFileIsComparedOnAnyMesh) {
  const TempFolder folder;
  LiveViewer live(boxToCompare());
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  writeWholeFile(folder / "coarse.ply", plyBytes(shown(live), false, 1));
  live.performAndWait("reference", folder / "coarse.ply");
  ASSERT_FALSE(live->error());
  const ReferenceLight same = *live->ui().settings.view.reference;
  const ReferenceLight now = referenceLight(shown(live), {}, "now");
  EXPECT_EQ(same.name, "coarse.ply");
  EXPECT_NEAR(same.mean, now.mean, 1e-5 * now.mean);
  const std::uint64_t epoch = live->state().epoch;
  live->perform("elements", "900");
  ASSERT_TRUE(live.until(
      [&] { return live->state().epoch > epoch && live->state().phase == SessionPhase::kConverged; }));
  EXPECT_EQ(live->ui().settings.view.reference, nullptr) << "that of another mesh";
  live.performAndWait("reference", folder / "coarse.ply");
  ASSERT_FALSE(live->error());
  const ReferenceLight finer = *live->ui().settings.view.reference;
  EXPECT_EQ(finer.mesh, shown(live).mesh);
  EXPECT_NEAR(finer.mean, now.mean, 0.1 * now.mean);
  live->perform("open", std::string(UNSHOT_SOURCE_DIR) + "/assets/two_patches.obj");
  ASSERT_TRUE(live.until([&] {
    return live->state().facts->scene_name == "two_patches" &&
           live->state().phase == SessionPhase::kConverged;
  }));
  live.performAndWait("reference", folder / "coarse.ply");
  ASSERT_TRUE(live->error());
  EXPECT_THAT(live->error()->what(), HasSubstr("another scene"));
}

TEST(Comparison, AgainShootsFromNothingAndKnowsTheTruthAfterDirect) {
  LiveViewer::Options options = boxToCompare();
  options.solve.mode = "direct";
  LiveViewer live(options);
  ASSERT_TRUE(live.untilPhase(SessionPhase::kConverged));
  ASSERT_TRUE(live->state().measures.true_error);
  EXPECT_LT(*live->state().measures.true_error, 1e-9);
  const std::uint64_t epoch = live->state().epoch;
  live->perform("mode", "southwell");
  live->perform("remember");
  live->perform("again");
  ASSERT_TRUE(live.until(
      [&] { return live->state().epoch > epoch && live->state().phase == SessionPhase::kConverged; }));
  EXPECT_TRUE(live->ui().settings.view.reference) << "of the same mesh";
  const Measures& m = live->state().measures;
  EXPECT_EQ(m.rows, 0u) << "computed again";
  EXPECT_GT(m.shots, 100u);
  for (const HistoryEntry& entry : *live->state().history) {
    ASSERT_TRUE(entry.measures.true_error);
    EXPECT_LE(*entry.measures.true_error, entry.measures.bounds.upper);
    EXPECT_GE(*entry.measures.true_error * (1 + 1e-9), entry.measures.bounds.lower);
  }
  EXPECT_GT(*live->state().history->front().measures.true_error, 0.5);
  EXPECT_LT(*m.true_error, 0.1);
  live->perform("restart");
  ASSERT_TRUE(live.until(
      [&] { return live->state().epoch > epoch + 1 && live->state().phase == SessionPhase::kConverged; }));
  EXPECT_FALSE(live->state().measures.true_error);
}

}  // namespace
}  // namespace unshot
