// Light by bounces on made-up systems, against powers of M worked out densely.
#include "solver/bounce_series.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/modes.h"
#include "support/table_method.h"

namespace unshot {
namespace {

using namespace testing_support;

struct SeriesRun {
  TableSystem system;
  Transport transport;
  RadiosityState state;
  BounceSeries series;

  explicit SeriesRun(TableSystem system_in, std::size_t kept_bytes = std::size_t{1} << 24)
      : system(std::move(system_in)),
        transport(system.transport(kept_bytes)),
        state(transport, system.emission, system.reflectance),
        series(transport, state) {}

  void shootAll(IterationMode& mode, int steps) {
    for (int k = 0; k < steps && mode.step(state, transport); ++k) {
    }
  }
  void finish() {
    for (int k = 0; k < 1000 && !series.done(); ++k) series.advance();
  }
};

std::vector<double> times(const DenseMatrix& m, const std::vector<double>& x) {
  std::vector<double> out(x.size(), 0.0);
  for (std::size_t p = 0; p < x.size(); ++p) {
    for (std::size_t q = 0; q < x.size(); ++q) out[p] += m[p][q] * x[q];
  }
  return out;
}

TEST(BounceSeries, IsThePowersOfM) {
  SeriesRun run(randomSystem(3, 20, 2, true, 0.9));
  const auto mode = makeSouthwell();
  run.shootAll(*mode, 300);
  run.finish();
  ASSERT_GT(run.series.powers().size(), 8u);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> bounce;
    for (const glm::dvec3& e : run.system.emission) bounce.push_back(e[c]);
    for (const glm::dvec3& power : run.series.powers()) {
      double expected = 0;
      for (std::size_t q = 0; q < bounce.size(); ++q) expected += run.system.patch_area[q] * bounce[q];
      EXPECT_NEAR(power[c], expected, 1e-12 * expected);
      bounce = times(run.system.transportMatrix(c), bounce);
    }
  }
}

TEST(BounceSeries, IsWhatJacobiShoots) {
  SeriesRun run(randomSystem(4, 20, 2, false, 0.95));
  const auto jacobi = makeJacobi();
  run.shootAll(*jacobi, 400);
  run.finish();
  const std::vector<glm::dvec3> shot = jacobi->bouncePowers();
  ASSERT_GT(shot.size(), 5u);
  for (std::size_t k = 0; k < std::min(shot.size(), run.series.powers().size()); ++k) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shot[k][c], run.series.powers()[k][c], 1e-12 * shot[k][c]);
  }
}

TEST(BounceSeries, LightOfNBouncesIsTheStateAfterNSweeps) {
  const TableSystem system = randomSystem(5, 16, 3, true, 0.9);
  SeriesRun all(system);
  const auto southwell = makeSouthwell();
  all.shootAll(*southwell, 300);
  for (std::uint64_t n = 1; n <= 4; ++n) {
    while (all.series.powers().size() < n + 1) all.series.advance();
    SeriesRun swept(system);
    const auto mode = makeBounces(n);
    swept.shootAll(*mode, 1000);
    EXPECT_FALSE(mode->step(swept.state, swept.transport).has_value());
    for (std::size_t v = 0; v < swept.state.irradiance().size(); ++v) {
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(all.series.received()[v][c], swept.state.irradiance()[v][c], 1e-12) << n;
    }
    EXPECT_GT(swept.state.unshotPower(), 0);
  }
}

// A furnace: rows of K sum to 1, so that every bounce has rho times the power of the one before.
TEST(BounceSeries, FallsByTheReflectanceInAFurnace) {
  TableSystem system = randomSystem(6, 24, 2, false, 1);
  const glm::dvec3 rho(0.25, 0.5, 0.875);
  std::fill(system.reflectance.begin(), system.reflectance.end(), rho);
  std::fill(system.emission.begin(), system.emission.end(), glm::dvec3(1, 2, 3));
  SeriesRun run(system);
  const auto mode = makeJacobi();
  run.shootAll(*mode, 100);
  run.finish();
  ASSERT_EQ(run.series.powers().size(), BounceSeries::kMost + 1);
  for (std::size_t k = 1; k < run.series.powers().size(); ++k) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(run.series.powers()[k][c] / run.series.powers()[k - 1][c], rho[c], 1e-12);
  }
}

TEST(BounceSeries, WaitsForColumnsAndComputesNone) {
  SeriesRun run(randomSystem(7, 20, 2, false, 0.9));
  EXPECT_FALSE(run.series.advance());
  EXPECT_FALSE(run.series.missing().empty());
  const auto mode = makeSouthwell();
  run.shootAll(*mode, 3);
  EXPECT_FALSE(run.series.advance());
  EXPECT_EQ(run.system.calls->columns, 3);
  for (int k = 0; k < 100 && !run.series.missing().empty(); ++k) {
    const std::size_t before = run.series.missing().size();
    run.transport.column(run.series.missing().front());
    EXPECT_GE(run.series.missing().size() + 1, before);
  }
  // What light reaches through columns that nothing has shot along yet is found out on the way.
  for (int k = 0; k < 2000 && !run.series.done(); ++k) {
    if (run.series.missing().empty()) {
      run.series.advance();
    } else {
      run.transport.column(run.series.missing().front());
    }
  }
  EXPECT_TRUE(run.series.done());
  EXPECT_LE(run.system.calls->columns, 20);
}

TEST(BounceSeries, StartsAnewWithOtherColumns) {
  SeriesRun run(randomSystem(8, 12, 2, false, 0.9));
  run.state.shoot(0, run.state.unshot()[0], run.transport.column(0));
  const auto mode = makeJacobi();
  run.shootAll(*mode, 200);
  run.finish();
  ASSERT_TRUE(run.series.done());
  run.transport.row(0);  // anything computed: other columns may be there
  run.series.follow();
  EXPECT_TRUE(run.series.powers().empty());
  run.finish();
  EXPECT_TRUE(run.series.done());
}

TEST(BounceSeries, JacobiHalfWayIsNoSeries) {
  SeriesRun run(randomSystem(9, 12, 2, false, 0.9));
  const auto first = makeSouthwell();
  run.shootAll(*first, 4);
  const auto jacobi = makeJacobi();
  run.shootAll(*jacobi, 50);
  EXPECT_TRUE(jacobi->bouncePowers().empty());
}

}  // namespace
}  // namespace unshot
