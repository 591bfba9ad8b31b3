// Bounds of the solver's error on made-up systems, against elimination.
#include "solver/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/modes.h"
#include "support/table_method.h"

namespace unshot {
namespace {

using namespace testing_support;

/// A state with its bounds, and the truth beside it.
struct BoundedRun {
  TableSystem system;
  Transport transport;
  RadiosityState state;
  PatchMatrix matrix;
  ErrorBounds bounds;
  std::vector<double> exact[3];

  explicit BoundedRun(TableSystem system_in)
      : system(std::move(system_in)),
        transport(system.transport()),
        state(transport, system.emission, system.reflectance),
        matrix(transport.receivers(), transport.patchArea(), std::size_t{1} << 24),
        bounds(matrix, state) {
    transport.watchColumns([this](std::uint32_t q, const Column& column) {
      matrix.set(q, column);
      bounds.columnChanged(q);
    });
    for (int c = 0; c < 3; ++c) exact[c] = system.solution(c);
  }

  struct Errors {
    double total = 0, rms = 0;
  };
  /// On patches without emission, or on those that emit where `of_emitters`.
  Errors errors() const {
    double error = 0, truth = 0, error2 = 0, truth2 = 0;
    for (std::size_t q = 0; q < system.patch_area.size(); ++q) {
      if ((system.emission[q] != glm::dvec3(0.0)) != of_emitters) continue;
      for (int c = 0; c < 3; ++c) {
        const double a = system.patch_area[q], e = exact[c][q] - state.shot()[q][c] - state.unshot()[q][c];
        const double reflected = exact[c][q] - system.emission[q][c];
        error += a * std::abs(e);
        truth += a * reflected;
        error2 += a * e * e;
        truth2 += a * reflected * reflected;
      }
    }
    return {error / truth, std::sqrt(error2 / truth2)};
  }
  bool of_emitters = false;
  void expectToHold(const SolverBounds& b) const {
    // What rounding of the state itself leaves (some hundred sums in double).
    const double slack = 1e-12;
    const Errors e = errors();
    EXPECT_GE(b.total_upper * (1 + 1e-9) + slack, e.total);
    EXPECT_LE(b.total_lower * (1 - 1e-9) - slack, e.total);
    EXPECT_GE(b.upper * (1 + 1e-9) + slack, e.rms);
    EXPECT_LE(b.lower * (1 - 1e-9) - slack, e.rms);
  }
};

TableSystem withWhiteWalls(TableSystem system) {
  for (std::size_t q = 0; q < system.reflectance.size(); ++q) {
    if (q % 4 == 1) system.reflectance[q] = glm::dvec3(1.0);
    if (q % 4 == 2) system.reflectance[q] = glm::dvec3(0.0, 0.5, 1.0);
  }
  return system;
}

class BoundsOfMode : public testing::TestWithParam<IterationModeRow> {};

TEST_P(BoundsOfMode, HoldAtEveryStep) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    TableSystem system = randomSystem(seed, 18, 2, false, seed % 2 ? 1.0 : 0.9);
    if (seed > 2) system = withWhiteWalls(system);
    BoundedRun run(system);
    const auto mode = GetParam().make();
    for (int k = 0; k < 600; ++k) {
      if (!mode->step(run.state, run.transport)) break;
      run.expectToHold(run.bounds.at());
      if (k % 3 == 0) run.bounds.refresh();
      run.expectToHold(run.bounds.at());
      run.expectToHold(run.bounds.sharpened(3));
    }
    for (int k = 0; k < 30; ++k) run.bounds.refresh();
    ASSERT_TRUE(run.bounds.complete());
    const SolverBounds last = run.bounds.sharpened(8);
    run.expectToHold(last);
    EXPECT_LT(last.upper, kNoBound) << seed;
    EXPECT_LT(last.total_upper, kNoBound) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BoundsOfMode,
                         testing::ValuesIn(iterationModes().begin(), iterationModes().end()),
                         [](const auto& row) {
                           std::string name(row.param.info.key);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// An odd number of patches, all of which may emit; and the one way of bounding the RMS error that at() keeps
// to between sharpenings, on states that have gone on.
TEST(Bounds, HoldBetweenSharpenings) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    TableSystem system = randomSystem(seed, 17, 2, false, 0.95);
    if (seed > 3) std::fill(system.emission.begin(), system.emission.end(), glm::dvec3(1.0, 0.5, 2.0));
    BoundedRun run(system);
    run.of_emitters = seed > 3;
    const auto mode = makeGaussSeidel();
    for (int k = 0; k < 40; ++k) mode->step(run.state, run.transport);
    for (int k = 0; k < 30; ++k) run.bounds.refresh();
    ASSERT_TRUE(run.bounds.comparable());
    for (int k = 0; k < 200; ++k) {
      if (k % 50 == 0) run.bounds.sharpened(4);
      if (!mode->step(run.state, run.transport)) break;
      run.expectToHold(run.bounds.at());
    }
    EXPECT_LT(run.bounds.at().upper, 1e-3) << seed;
  }
}

// Any d, of either sign, with some columns never computed.
TEST(Bounds, HoldForUnshotLightOfEitherSign) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    BoundedRun run(randomSystem(seed, 16, 2, seed % 2 == 0, 0.97));
    Dice dice(seed);
    for (int k = 0; k < 120; ++k) {
      const std::uint32_t q = dice.below(k < 60 ? 10 : 16);
      run.state.shoot(q, k % 2 ? run.state.unshot()[q] : 0.3 * dice.inCube(2), run.transport.column(q));
      if (k % 5 == 0) run.bounds.refresh();
      run.expectToHold(run.bounds.at());
      run.expectToHold(run.bounds.sharpened(2));
    }
  }
}

// What emits nothing is black, or sees other patches than lamps alone do: what lamps reflect is all there is.
TEST(Bounds, AreOfEmittersWhereNothingElseReflectsLight) {
  for (const bool black : {true, false}) {
    TableSystem system = randomSystem(9, 15, 2, false, 0.9);
    const auto emits = [&](std::uint32_t q) { return system.emission[q] != glm::dvec3(0.0); };
    for (std::uint32_t q = 0; q < 15; ++q) {
      if (black && !emits(q)) system.reflectance[q] = glm::dvec3(0.0);
    }
    for (const auto& share : system.receivers.shares) {
      system.receivers.reflectance[share.receiver] = system.reflectance[share.patch];
      for (std::uint32_t q = 0; q < 15 && !black; ++q) {
        if (emits(q) != emits(share.patch)) system.k[share.receiver][q] = 0;
      }
    }
    BoundedRun run(system);
    run.of_emitters = true;
    const auto mode = makeSouthwell();
    for (int k = 0; k < 60; ++k) {
      if (!mode->step(run.state, run.transport)) break;
      run.bounds.refresh();
      run.expectToHold(run.bounds.at());
      run.expectToHold(run.bounds.sharpened(3));
    }
    for (int k = 0; k < 30; ++k) run.bounds.refresh();
    const SolverBounds last = run.bounds.sharpened(8);
    EXPECT_LT(last.upper, 0.01) << black;
    EXPECT_LT(last.total_upper, 0.01) << black;
    EXPECT_GT(last.upper, 0) << black;
  }
}

TEST(Bounds, AreNotFarFromTheTruth) {
  BoundedRun run(randomSystem(5, 40, 2, false, 0.95));
  const auto mode = makeSouthwell();
  std::vector<double> ratio;
  for (int k = 0; k < 400; ++k) {
    mode->step(run.state, run.transport);
    run.bounds.refresh();
    const SolverBounds b = run.bounds.sharpened(4);
    if (b.upper < kNoBound) ratio.push_back(b.upper / run.errors().rms);
    if (b.upper < kNoBound) {
      EXPECT_GT(b.lower, 0.3 * run.errors().rms);
    }
  }
  ASSERT_GT(ratio.size(), 200u);
  std::nth_element(ratio.begin(), ratio.begin() + ratio.size() / 2, ratio.end());
  EXPECT_LT(ratio[ratio.size() / 2], 1.5);
}

// The total bound is the error itself where U >= 0 and all columns are known: its weights are then exact.
TEST(Bounds, GiveTheTotalErrorExactlyInTheEnd) {
  BoundedRun run(randomSystem(6, 24, 2, false, 0.9));
  const auto mode = makeGaussSeidel();
  for (int k = 0; k < 60; ++k) mode->step(run.state, run.transport);
  for (int k = 0; k < 60; ++k) run.bounds.refresh();
  const double bound = run.bounds.at().total_upper, error = run.errors().total;
  EXPECT_GE(bound, error);
  // 60 bounces at 0.9 leave the weights at most 0.9^60 = 0.2 % of the largest short.
  EXPECT_GT(run.bounds.at().total_lower, 0.99 * error);
  EXPECT_LE(run.bounds.at().total_lower, error);
  // relative to the truth from below, so a little above it
  EXPECT_LT(bound, error * 1.1 / (1 - error));
}

// A small patch that sends several times its light, as sums over receivers do in narrow places: what others
// would send that nobody asked for is not taken to be as much.
TEST(Bounds, AreThereBeforeAllColumnsAreWhereOneSendsTooMuch) {
  constexpr double kReflectance = 0.3;
  constexpr std::uint32_t kSmall = 7;
  constexpr double kSmaller = 0.1;
  TableSystem system = randomSystem(11, 120, 1, false, 0.8);
  std::fill(system.reflectance.begin(), system.reflectance.end(), glm::dvec3(kReflectance));
  for (PatchShare& share : system.receivers.shares) {
    if (share.patch != kSmall) continue;
    share.area *= kSmaller;
    system.receivers.area[share.receiver] *= kSmaller;
  }
  system.patch_area[kSmall] *= kSmaller;
  BoundedRun run(system);
  for (int round = 0; round < 8; ++round) {
    for (std::uint32_t q = 0; q < 60; ++q) {
      const glm::dvec3 all = run.state.unshot()[q];
      run.state.shoot(q, all, run.transport.column(q));
      run.expectToHold(run.bounds.at());
    }
    run.bounds.refresh();
    run.expectToHold(run.bounds.at());
  }
  ASSERT_GT(run.matrix.largestSent() * kReflectance, 1) << "it alone would leave no bound";
  EXPECT_LT(run.matrix.usuallySent() * kReflectance, 1);
  EXPECT_FALSE(run.bounds.complete());
  EXPECT_LT(run.bounds.at().total_upper, kNoBound);
}

TEST(Bounds, BracketTheSpectralRadius) {
  TableSystem system = randomSystem(7, 20, 2, false, 1);
  std::fill(system.reflectance.begin(), system.reflectance.end(), glm::dvec3(0.5, 0.75, 0.875));
  BoundedRun run(system);
  const auto mode = makeJacobi();
  for (int k = 0; k < 100; ++k) mode->step(run.state, run.transport);
  for (int k = 0; k < 60; ++k) run.bounds.refresh();
  for (int c = 0; c < 3; ++c) {
    const double rho = system.reflectance[0][c];  // rows sum to 1: M 1 = rho 1
    EXPECT_LE(run.bounds.spectralRadiusLower()[c], rho * (1 + 1e-6));
    EXPECT_GE(run.bounds.spectralRadiusUpper()[c], rho * (1 - 1e-6));
    EXPECT_NEAR(run.bounds.spectralRadiusUpper()[c], rho, 1e-5);
    // expected bounces of a furnace: 1 / (1 - rho)
    for (const glm::dvec3& v : run.bounds.expectedBounces())
      EXPECT_NEAR(v[c], 1 / (1 - rho), 0.02 / (1 - rho));
  }
}

TEST(Bounds, AreNoneWhereNothingDiesOut) {
  TableSystem system = randomSystem(8, 12, 2, false, 1);
  std::fill(system.reflectance.begin(), system.reflectance.end(), glm::dvec3(1.0));
  BoundedRun run(system);
  const auto mode = makeJacobi();
  for (int k = 0; k < 60; ++k) mode->step(run.state, run.transport);
  run.bounds.refresh();
  EXPECT_EQ(run.bounds.at().upper, kNoBound);
  EXPECT_EQ(run.bounds.at().total_upper, kNoBound);
}

}  // namespace
}  // namespace unshot
