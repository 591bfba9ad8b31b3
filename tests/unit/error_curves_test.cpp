// Curves of error against cost: what is read off them, and the runs that they are made from.
#include "report/error_curves.h"

#include <gmock/gmock.h>

#include <cmath>

#include "gl/context.h"
#include "report/curve_record.h"
#include "report/curve_runs.h"
#include "report/page.h"
#include "solver/modes.h"
#include "support/assets.h"

namespace unshot {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing_support::assetScene;

CurvePoint curvePointOf(double seconds, double error, std::uint64_t rows = 0) {
  CurvePoint point;
  point.cpu_seconds = seconds;
  point.rows = rows;
  point.solver = SolverError{error, error};
  return point;
}

std::optional<double> timeTo(const std::vector<CurvePoint>& points, double level) {
  return costToReach(points, level, solverErrorOf, busySecondsOf);
}

TEST(CostToReach, IsExactOnAPowerLaw) {
  std::vector<CurvePoint> points;
  for (double t = 0.01; t < 100; t *= 1.3) points.push_back(curvePointOf(t, std::pow(t / 0.01, -1.5)));
  for (const double level : kErrorLevels) {
    const double exact = 0.01 * std::pow(level, -1 / 1.5);
    ASSERT_TRUE(timeTo(points, level));
    EXPECT_NEAR(*timeTo(points, level), exact, 1e-12 * exact) << level;
  }
}

TEST(CostToReach, AJumpIsReachedWhereItLands) {
  const std::vector<CurvePoint> points{curvePointOf(1, 0.5), curvePointOf(2, 0.4), curvePointOf(3, 1e-14),
                                       curvePointOf(4, 0)};
  EXPECT_EQ(timeTo(points, 0.4), 2);
  EXPECT_EQ(timeTo(points, 0.1), 3);
  EXPECT_EQ(timeTo(points, 1e-15), 4);
}

TEST(CostToReach, NothingWhereItIsNotReachedOrNotMeasured) {
  std::vector<CurvePoint> points{curvePointOf(1, 0.5), curvePointOf(2, 0.4)};
  EXPECT_FALSE(timeTo(points, 0.3));
  EXPECT_FALSE(timeTo({}, 0.3));
  EXPECT_FALSE(costToReach(points, 0.5, totalErrorOf, busySecondsOf));
  points.insert(points.begin() + 1, curvePointOf(1.5, 0));
  points[1].solver.reset();
  EXPECT_EQ(timeTo(points, 0.4), 2) << "points without a value are passed over";
}

TEST(PointAtCost, IsTheLastThatIsPaidFor) {
  const std::vector<CurvePoint> points{curvePointOf(1, 1, 0), curvePointOf(2, 1, 3), curvePointOf(4, 1, 3)};
  EXPECT_EQ(pointAtCost(points, 0.5, busySecondsOf), 0u);
  EXPECT_EQ(pointAtCost(points, 3.9, busySecondsOf), 1u);
  EXPECT_EQ(pointAtCost(points, 3, rowsOf), 2u);
}

TEST(Medians, AreOverTheRunsThatCameToThePoint) {
  ModeCurve curve;
  curve.points.resize(2);
  curve.runs = {{{1, 10}, {2, 20}}, {{3, 30}, {6, 60}}, {{2}, {5}}};
  takeMedians(curve);
  EXPECT_EQ(curve.points[0].cpu_seconds, 2);
  EXPECT_EQ(curve.points[0].seconds, 5);
  EXPECT_EQ(curve.points[1].cpu_seconds, 20);
  EXPECT_EQ(curve.points[1].cpu_seconds_min, 10);
  EXPECT_EQ(curve.points[1].cpu_seconds_max, 30);
}

/// A method that counts.
class Counting final : public FormFactorMethod {
 public:
  explicit Counting(int& columns) : columns_(columns) {}
  ReceiverKind receiverKind() const override { return ReceiverKind::kVertices; }
  Column column(std::uint32_t q) override {
    ++columns_;
    Column out;
    out.k.assign(8, static_cast<float>(q));
    return out;
  }
  Row row(std::uint32_t) override { return {}; }

 private:
  int& columns_;
};

TEST(ColumnStore, ComputesOnceAndChargesEveryRun) {
  int computed = 0;
  ColumnStore store(1000);
  auto first = store.wrap(std::make_unique<Counting>(computed));
  EXPECT_EQ(first->column(3).k[0], 3);
  const double cost = store.spent().cpu_seconds;
  EXPECT_EQ(store.charged().cpu_seconds, 0);
  auto second = store.wrap(std::make_unique<Counting>(computed));
  EXPECT_EQ(store.spent().cpu_seconds, 0);
  EXPECT_EQ(second->column(3).k[0], 3);
  EXPECT_EQ(computed, 1);
  EXPECT_EQ(store.charged().cpu_seconds, cost);
  store.measureAnew();
  auto third = store.wrap(std::make_unique<Counting>(computed));
  third->column(3);
  EXPECT_EQ(computed, 2);
  third->column(3);
  EXPECT_EQ(computed, 2);
  EXPECT_FALSE(store.full());
}

TEST(ColumnStore, BeyondItsRoomColumnsAreComputedAgain) {
  int computed = 0;
  ColumnStore store(40);
  auto method = store.wrap(std::make_unique<Counting>(computed));
  for (const std::uint32_t q : {0u, 1u, 0u, 1u}) EXPECT_EQ(method->column(q).k[0], static_cast<float>(q));
  EXPECT_EQ(computed, 3);
  EXPECT_TRUE(store.full());
  EXPECT_LE(store.bytes(), 40u);
}

SolveOptions closedForm(double error, std::uint64_t elements) {
  SolveOptions options;
  options.form_factors = "closed-form";
  options.elements = elements;
  options.error = error;
  return options;
}

gl::Context& noContext() { throw Error(ErrorKind::kInternal, "closed forms do not draw"); }

bool goOn(double) { return true; }

// B = E / (1 - rho) = 1, and after k sweeps what is missing of it is rho^(k+1); of the reflected light,
// rho^k.
TEST(SolverError, OfJacobiInAFurnaceFallsByRhoWithEverySweep) {
  SolveOptions options = closedForm(1e-7, 400);
  options.mode = "jacobi";
  Solve solve(assetScene("furnace.obj"), options, noContext);
  const std::vector<glm::dvec3> exact(solve.mesh().patch_count, glm::dvec3(1.0));
  EXPECT_NEAR(solverError(solve.mesh(), solve.patchRadiosity(), exact).nrmse, 1, 1e-12);
  for (std::uint64_t k = 1; k <= 10; ++k) {
    while (solve.measures().shots < k * solve.mesh().patch_count) solve.step();
    ASSERT_EQ(solve.measures().shots, k * solve.mesh().patch_count);
    const double expected = std::pow(0.5, static_cast<double>(k));
    const double tolerance = 1e-5 * expected + 1e-7;  // rows add up to 1 in single precision
    const SolverError error = solverError(solve.mesh(), solve.patchRadiosity(), exact);
    EXPECT_NEAR(error.nrmse, expected, tolerance) << k;
    EXPECT_NEAR(error.total, expected, tolerance) << k;
    for (const glm::dvec3& b : solve.patchRadiosity()) EXPECT_NEAR(1 - b.x, expected / 2, tolerance);
  }
}

TEST(SolverError, OfTheExactSolutionIsZeroAndLampsDoNotCount) {
  const Scene scene = assetScene("cornell_box.obj");
  SolveOptions options =
      closedForm(1e-6, 150);  // closed form: shadows are left out, which is all the same here
  CurveRuns runs(scene, options, noContext);
  const ExactSolution exact = runs.solveExactly(60, goOn);
  ASSERT_FALSE(exact.radiosity.empty()) << exact.why_not;
  EXPECT_EQ(exact.mode, "direct");
  Solve solve(scene, options, noContext);
  EXPECT_EQ(solverError(solve.mesh(), exact.radiosity, exact.radiosity).nrmse, 0);
  std::vector<glm::dvec3> brighter = exact.radiosity;
  for (std::size_t q = 0; q < brighter.size(); ++q) {
    if (solve.mesh().sides[solve.mesh().patch_side[q]].emission != glm::dvec3(0.0)) brighter[q] *= 2.0;
  }
  EXPECT_EQ(solverError(solve.mesh(), brighter, exact.radiosity).nrmse, 0);
}

// Every mode, from E to the exact solution, between its bounds all the way.
class Curves : public testing::TestWithParam<std::string> {};

TEST_P(Curves, FallFromAllToTheErrorAskedForBetweenTheirBounds) {
  const Scene scene = assetScene("cornell_box.obj");
  CurveRuns runs(scene, closedForm(1e-4, 300), noContext);
  const ExactSolution exact = runs.solveExactly(60, goOn);
  ASSERT_FALSE(exact.radiosity.empty()) << exact.why_not;
  ModeCurve curve = runs.run(GetParam(), exact.radiosity, 60, {}, goOn);
  ASSERT_FALSE(curve.failure) << curve.failure->what();
  ASSERT_GT(curve.points.size(), 5u);
  EXPECT_NEAR(curve.points.front().solver->nrmse, 1, 1e-9);
  EXPECT_LE(curve.points.back().solver->nrmse, 1e-4);
  EXPECT_GT(curve.kept_bytes, 0u);
  EXPECT_GT(curve.working_bytes_max, 0u);
  const CurvePoint* last = nullptr;
  for (const CurvePoint& p : curve.points) {
    const double tolerance = 1e-6 * p.solver->nrmse + 1e-9;
    EXPECT_LE(p.solver->total, p.bounds.total_upper + tolerance);
    EXPECT_LE(p.solver->nrmse, p.bounds.upper + tolerance);
    EXPECT_GE(p.solver->nrmse, p.bounds.lower - tolerance);
    if (last) {
      EXPECT_GT(p.step, last->step);
      EXPECT_GE(p.cpu_seconds, last->cpu_seconds);
      EXPECT_GE(p.rows, last->rows);
    }
    last = &p;
  }
  runs.repeat(curve, goOn);
  ASSERT_EQ(curve.runs.size(), 2u);
  EXPECT_EQ(curve.runs[1].cpu_seconds.size(), curve.points.size());
  const std::vector<std::uint64_t> steps{curve.points[3].step, curve.points.back().step};
  std::vector<double> errors;
  runs.statesAt(
      GetParam(), steps,
      [&](std::size_t, const Solve& solve) {
        errors.push_back(solverError(solve.mesh(), solve.patchRadiosity(), exact.radiosity).nrmse);
      },
      goOn);
  EXPECT_EQ(errors, (std::vector<double>{curve.points[3].solver->nrmse, curve.points.back().solver->nrmse}));
}

std::vector<std::string> modeKeys() {
  std::vector<std::string> keys;
  for (const IterationModeRow& row : iterationModes()) keys.emplace_back(row.info.key);
  return keys;
}

INSTANTIATE_TEST_SUITE_P(Modes, Curves, testing::ValuesIn(modeKeys()), [](const auto& row) {
  std::string name;
  for (const char c : row.param) name += std::isalpha(static_cast<unsigned char>(c)) ? std::string(1, c) : "";
  return name;
});

// Drafts of form factors make a system of their own, whose bounds say nothing of the one with full ones.
TEST(CurveRuns, HaveBoundsOfTheSystemThatErrorsAreOf) {
  const Scene scene = assetScene("cornell_box.obj");
  const auto context = gl::createContext("osmesa");
  context->makeCurrent();
  SolveOptions options = closedForm(1e-3, 600);
  options.form_factors = "hemicube";
  CurveRuns runs(scene, options, [&]() -> gl::Context& { return *context; });
  const ExactSolution exact = runs.solveExactly(60, goOn);
  ASSERT_FALSE(exact.radiosity.empty()) << exact.why_not;
  const auto bounded = [](const ModeCurve& curve) {
    std::size_t count = 0;
    for (const CurvePoint& p : curve.points) {
      // Form factors in single precision.
      const double tolerance = 1e-5 * p.solver->nrmse + 1e-7;
      EXPECT_LE(p.solver->total, p.bounds.total_upper + tolerance);
      EXPECT_LE(p.solver->nrmse, p.bounds.upper + tolerance);
      EXPECT_GE(p.solver->nrmse, p.bounds.lower - tolerance);
      count += p.bounds.total_upper < kNoBound;
    }
    return count;
  };
  const ModeCurve with_drafts = runs.run("southwell", exact.radiosity, 60, {}, goOn);
  ASSERT_FALSE(with_drafts.failure);
  EXPECT_TRUE(with_drafts.drafts);
  EXPECT_LT(bounded(with_drafts), with_drafts.points.size() / 2);
  EXPECT_LT(with_drafts.points.back().bounds.upper, 1e-3);
  const ModeCurve without = runs.runBounded("southwell", exact.radiosity, 60, goOn);
  ASSERT_FALSE(without.failure);
  EXPECT_FALSE(without.drafts);
  EXPECT_GE(bounded(without), without.points.size() - 1);
  EXPECT_TRUE(runs.run("southwell", exact.radiosity, 60, {}, goOn).drafts);
}

TEST(CurveRuns, WithoutLightThereIsNothingToMeasure) {
  Scene scene = assetScene("furnace.obj");
  for (Material& m : scene.materials) m.emission = glm::dvec3(0.0);
  SolveOptions options = closedForm(1e-3, 60);
  options.sky = glm::dvec3(0.0);
  CurveRuns runs(scene, options, noContext);
  try {
    runs.solveExactly(60, goOn);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
  }
}

TEST(CurveRuns, EndsWhenToldTo) {
  const Scene scene = assetScene("furnace.obj");
  CurveRuns runs(scene, closedForm(1e-3, 60), noContext);
  int left = 4;
  const auto stop = [&](double) { return --left > 0; };
  EXPECT_TRUE(runs.solveExactly(60, [](double) { return false; }).interrupted);
  const ModeCurve curve = runs.run("southwell", {}, 60, {}, stop);
  EXPECT_EQ(curve.stopped_by, "interrupted");
  EXPECT_EQ(curve.points.back().step, 4u);
}

TEST(Page, ShowsTextAsTextAndSaysWhatIsMissing) {
  CurveRecord record;
  record.scene_name = "a<b & \"c\"";
  record.folder = "a_b";
  record.exact.radiosity = {glm::dvec3(1.0)};
  ModeCurve curve;
  curve.mode = "jacobi";
  curve.points = {curvePointOf(0.1, 1, 0), curvePointOf(1, 0.02, 100)};
  curve.runs = {{{0.1, 1}, {0.1, 1}}};
  record.curves = {curve, {}};
  record.curves[1].mode = "direct";
  record.curves[1].left_out = "too large";
  const PageScene scene{&record, {{"error_over_time", "<svg/>"}}, "", {}};
  const std::string html = pageHtml({&scene, 1}, {"a machine", "a command"});
  EXPECT_THAT(html, HasSubstr("a&lt;b &amp; &quot;c&quot;"));
  EXPECT_THAT(html, Not(HasSubstr("a<b")));
  EXPECT_THAT(html, HasSubstr("data:image/svg+xml;base64,PHN2Zy8+"));
  EXPECT_THAT(html, HasSubstr("error_over_rows.gp"));  // not drawn
  EXPECT_THAT(html, HasSubstr("not reached"));
  EXPECT_THAT(html, HasSubstr("direct is left out: too large"));
  EXPECT_THAT(html, Not(HasSubstr("http")));
}

}  // namespace
}  // namespace unshot
