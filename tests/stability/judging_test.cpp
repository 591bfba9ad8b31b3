// That the suite can fail, and that it knows what is an exception.
#include <gmock/gmock.h>

#include <cmath>

#include "scene/analytic_scenes.h"
#include "stability/lit_cube_truth.h"
#include "stability/scene_through_obj.h"
#include "stability/stability_scenes.h"
#include "support/stability.h"

namespace unshot {
namespace {

using namespace testing_support;
using testing::HasSubstr;

/// A furnace in which B = 2, of which so much is expected.
StabilityCase furnaceExpecting(double radiosity, double tolerance) {
  StabilityCase trial;
  trial.key = "furnace";
  trial.make = [] { return furnaceScene(0.5, 1.0); };
  trial.options.elements = 54;
  trial.options.error = 1e-5;
  trial.measure = [=](const Solve& s) {
    return meanFigures(s, "B", everySide(), glm::dvec3(radiosity), tolerance);
  };
  return trial;
}

TEST(StabilityVerdict, PassesWithinTheToleranceAndFailsBeyond) {
  EXPECT_EQ(stabilityOf(furnaceExpecting(2, 1e-3), "auto", "auto").verdict, Verdict::kPass);
  const StabilityResult off = stabilityOf(furnaceExpecting(2.1, 1e-3), "auto", "auto");
  EXPECT_EQ(off.verdict, Verdict::kFail);
  EXPECT_NEAR(off.figure.error(), 0.1 / 2.1, 1e-3);
  EXPECT_EQ(stabilityOf(furnaceExpecting(2, 0), "auto", "auto").verdict, Verdict::kFail) << "not exact";
}

TEST(StabilityVerdict, FailsWhatStopsShort) {
  StabilityCase trial = furnaceExpecting(2, 1);
  trial.options.max_shots = 1;
  const StabilityResult result = stabilityOf(trial, "auto", "auto");
  EXPECT_EQ(result.verdict, Verdict::kFail);
  EXPECT_THAT(result.note, HasSubstr("max_shots"));
}

TEST(StabilityVerdict, ExceptionsCoverNoMoreThanIsKnown) {
  StabilityCase trial = furnaceExpecting(2.1, 0.04);
  trial.exceptions = {{"southwell", "it is so", 1.5}};
  const StabilityResult known = stabilityOf(trial, "auto", "auto");
  EXPECT_EQ(known.verdict, Verdict::kException);
  EXPECT_THAT(known.note, HasSubstr("it is so"));
  EXPECT_EQ(stabilityOf(trial, "jacobi", "auto").verdict, Verdict::kFail) << "another mode";
  trial.exceptions[0].most = 1.1;
  EXPECT_EQ(stabilityOf(trial, "auto", "auto").verdict, Verdict::kFail) << "farther off than known";
  trial.exceptions[0].most = 0;
  EXPECT_EQ(stabilityOf(trial, "auto", "auto").verdict, Verdict::kFail) << "it did not stop";
  trial.options.max_shots = 1;
  EXPECT_EQ(stabilityOf(trial, "auto", "auto").verdict, Verdict::kException);
}

TEST(StabilityVerdict, AsksForTheWordsWhereThereIsNoSolution) {
  StabilityCase trial = furnaceExpecting(2, 1e-3);
  trial.no_solution = true;
  EXPECT_EQ(stabilityOf(trial, "auto", "auto").verdict, Verdict::kFail);
  trial.make = [] { return furnaceScene(1, 1.0); };
  EXPECT_EQ(stabilityOf(trial, "auto", "auto").verdict, Verdict::kPass);
}

TEST(StabilityVerdict, RefusedIsWhatTheProgramSaysItself) {
  StabilityCase trial = furnaceExpecting(2, 1e-3);
  trial.make = [] { return interpenetratingBlocks(); };
  const StabilityResult result = stabilityOf(trial, "auto", "closed-form");
  EXPECT_EQ(result.verdict, Verdict::kRefused);
  EXPECT_THAT(result.note, HasSubstr("occlusion"));
  trial.make = []() -> Scene { throw Error(ErrorKind::kEnvironment, "no folder"); };
  EXPECT_EQ(stabilityOf(trial, "auto", "auto").verdict, Verdict::kFail);
}

TEST(StabilityVerdict, FailsWithoutOpenGl) {
  const StabilityResult result =
      runStability(furnaceExpecting(2, 1), "auto", "hemicube",
                   []() -> gl::Context& { throw Error(ErrorKind::kEnvironment, "no OpenGL"); });
  EXPECT_EQ(result.verdict, Verdict::kFail);
  EXPECT_EQ(result.note, "no OpenGL");
}

TEST(StabilityFigure, ThatIsNoNumberIsNeverWithin) {
  EXPECT_FALSE((Figure{"B", NAN, 1, 10}).within());
  EXPECT_EQ((Figure{"B", NAN, 1, 10}).strain(), INFINITY);
  EXPECT_FALSE((Figure{"passes", 11, 10, 0, true}).within());
  EXPECT_TRUE((Figure{"passes", 9, 10, 0, true}).within());
}

TEST(StabilityCases, HaveKeysOfTheirOwnAndExceptionsOfTheTables) {
  std::set<std::string> keys, known;
  for (const IterationModeRow& row : iterationModes()) known.emplace(row.info.key);
  for (const FormFactorMethodRow& row : formFactorMethods()) known.emplace(row.info.key);
  for (const StabilityCase& trial : stabilityCases()) {
    EXPECT_TRUE(keys.insert(trial.key).second) << trial.key;
    EXPECT_TRUE(trial.no_solution || trial.measure) << trial.key;
    for (const KnownException& exception : trial.exceptions)
      EXPECT_EQ(known.count(std::string(exception.key)), 1u);
  }
}

// The sum over the six faces is that of a furnace, lit by a sixth.
TEST(LitCubeTruths, KeepTheEnergy) {
  for (const LitCubeTruth& t : litCubeTruths())
    EXPECT_NEAR((t.lit + t.opposite + 4 * t.side) * (1 - t.reflectance), 1, 2e-6) << t.reflectance;
}

TEST(SceneThroughObj, IsTheSameScene) {
  const Scene made = twoRoomsWithADoor(), read = throughObj(made);
  ASSERT_EQ(read.polygons.size(), made.polygons.size());
  EXPECT_EQ(read.triangle_count, made.triangle_count);
  for (std::size_t k = 0; k < made.polygons.size(); ++k) {
    const Polygon &a = made.polygons[k], &b = read.polygons[k];
    const Material &from = made.materials[a.material], &to = read.materials[b.material];
    EXPECT_LT(glm::distance(from.reflectance, to.reflectance), 1e-12);
    EXPECT_LT(glm::distance(from.emission, to.emission), 1e-12);
    for (std::uint32_t c = 0; c < a.corner_count; ++c) {
      EXPECT_LT(
          glm::distance(made.frame_origin + made.position(a, c), read.frame_origin + read.position(b, c)),
          1e-12);
    }
  }
}

}  // namespace
}  // namespace unshot
