// The S, H, U state on a made-up, non-reciprocal K, against the definitions.
#include "solver/state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/table_method.h"

namespace unshot {
namespace {

using namespace testing_support;

struct SolverRun {
  TableSystem system;
  Transport transport;
  RadiosityState state;

  SolverRun(std::uint64_t seed, bool shared)
      : system(randomSystem(seed, 14, 3, shared, 0.95)),
        transport(system.transport()),
        state(transport, system.emission, system.reflectance) {}

  void shootAtRandom(int shots, std::uint64_t seed) {
    Dice dice(seed);
    for (int k = 0; k < shots; ++k) {
      const std::uint32_t q = dice.below(14);
      // Not only all of U: a mode may shoot more, less, or below zero.
      const glm::dvec3 d = k % 3 == 0 ? dice.inCube(2) : state.unshot()[q];
      state.shoot(q, d, transport.column(q));
    }
  }
};

class State : public testing::TestWithParam<bool> {};

TEST_P(State, StartsWithAllLightUnshot) {
  const SolverRun run(1, GetParam());
  EXPECT_EQ(run.state.unshot(), run.system.emission);
  double power = 0;
  for (std::size_t q = 0; q < 14; ++q) {
    power += run.system.patch_area[q] *
             (run.system.emission[q].x + run.system.emission[q].y + run.system.emission[q].z);
  }
  EXPECT_NEAR(run.state.emittedPower(), power, 1e-12 * power);
  EXPECT_NEAR(run.state.unshotPower(), power, 1e-12 * power);
  for (const glm::dvec3& h : run.state.irradiance()) EXPECT_EQ(h, glm::dvec3(0.0));
}

// 60 shots of values of about 1 in double: rounding stays below 1e-13.
TEST_P(State, HoldsTheResidualOfTheEquationAsUnshot) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SolverRun run(seed, GetParam());
    run.shootAtRandom(60, seed);
    for (int c = 0; c < 3; ++c) {
      std::vector<double> shot;
      for (const glm::dvec3& s : run.state.shot()) shot.push_back(s[c]);
      const std::vector<double> reflected = multiply(run.system.transportMatrix(c), shot);
      const std::vector<double> received = multiply(run.system.k, shot);
      for (std::size_t v = 0; v < received.size(); ++v) {
        EXPECT_NEAR(run.state.irradiance()[v][c], received[v], 1e-12);
      }
      for (std::size_t q = 0; q < 14; ++q) {
        EXPECT_NEAR(run.state.unshot()[q][c], run.system.emission[q][c] + reflected[q] - shot[q], 1e-12);
      }
    }
  }
}

// emitted = absorbed + unshot + escaped + defect after every shot, whatever is shot.
TEST_P(State, AccountsForAllEnergyAtEveryStep) {
  SolverRun run(3, GetParam());
  for (int k = 0; k < 40; ++k) {
    run.shootAtRandom(1, static_cast<std::uint64_t>(k));
    double sum = run.state.escapedPower() + run.state.defectPower();
    for (int c = 0; c < 3; ++c) {
      for (std::size_t v = 0; v < run.transport.receiverCount(); ++v) {
        const Receivers& receivers = run.transport.receivers();
        sum += receivers.area[v] * (1 - receivers.reflectance[v][c]) * run.state.irradiance()[v][c];
      }
      for (std::size_t q = 0; q < 14; ++q) sum += run.state.area()[q] * run.state.unshot()[q][c];
    }
    EXPECT_NEAR(sum, run.state.emittedPower(), 1e-11 * run.state.emittedPower());
  }
}

TEST_P(State, HasNothingUnshotAtTheSolution) {
  SolverRun run(4, GetParam());
  const std::vector<double> r = run.system.solution(0), g = run.system.solution(1),
                            b = run.system.solution(2);
  for (std::uint32_t q = 0; q < 14; ++q) run.state.shoot(q, {r[q], g[q], b[q]}, run.transport.column(q));
  EXPECT_LT(run.state.unshotPower(), 1e-11 * run.state.emittedPower());
}

TEST_P(State, CountsUnshotPowerBelowZeroAsPower) {
  SolverRun run(5, GetParam());
  run.state.shoot(1, glm::dvec3(3.0), run.transport.column(1));
  double power = 0;
  for (std::size_t q = 0; q < 14; ++q) {
    for (int c = 0; c < 3; ++c) power += run.system.patch_area[q] * std::abs(run.state.unshot()[q][c]);
  }
  EXPECT_LT(run.state.unshot()[1].x, 0);
  EXPECT_NEAR(run.state.unshotPower(), power, 1e-12 * power);
}

// H_d = K E and H - H_d = K (S - E), however E is shot: in parts, with more on top, or some of it taken back.
TEST_P(State, HoldsTheLightStraightFromEmittersApart) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SolverRun run(seed, GetParam());
    Dice dice(seed);
    for (std::uint32_t q = 0; q < 14; ++q) {
      const glm::dvec3 e = run.system.emission[q];
      for (const double part : {0.25, -0.5, 0.5, 0.0, 2.0, 1.0}) {
        run.state.shoot(q, part * e, run.transport.column(q));
      }
    }
    const std::uint64_t shots = run.state.emissionShots();
    const std::vector<glm::dvec3> direct = run.state.direct();
    run.shootAtRandom(30, seed);
    EXPECT_EQ(run.state.emissionShots(), shots);
    EXPECT_EQ(run.state.direct(), direct);
    for (int c = 0; c < 3; ++c) {
      std::vector<double> emission, rest;
      for (std::size_t q = 0; q < 14; ++q) {
        emission.push_back(run.system.emission[q][c]);
        rest.push_back(run.state.shot()[q][c] - emission.back());
      }
      const std::vector<double> straight = multiply(run.system.k, emission);
      const std::vector<double> reflected = multiply(run.system.k, rest);
      for (std::size_t v = 0; v < straight.size(); ++v) {
        EXPECT_NEAR(direct[v][c], straight[v], 1e-12);
        EXPECT_NEAR(run.state.irradiance()[v][c] - direct[v][c], reflected[v], 1e-12);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Receivers, State, testing::Bool(),
                         [](const auto& row) { return row.param ? "SharedByPatches" : "OfOnePatch"; });

}  // namespace
}  // namespace unshot
