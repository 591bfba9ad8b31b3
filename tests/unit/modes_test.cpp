// Every iteration mode of the table on made-up systems, against elimination and against each other.
#include "solver/modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "support/table_method.h"

namespace unshot {
namespace {

using namespace testing_support;

// Steps until the unshot power is `share` of the emitted one; returns the shots, or 0 where it did not get
// there.
int solve(IterationMode& mode, RadiosityState& state, Transport& transport, double share) {
  for (int shots = 1; shots < 100'000; ++shots) {
    const bool shot = mode.step(state, transport).has_value();
    if (state.unshotPower() <= share * state.emittedPower()) return shots;
    if (!shot) break;
  }
  return 0;
}

bool shootsPatchByPatch(const IterationModeRow& row) {
  const auto keys = {"southwell", "kept-first", "jacobi", "gauss-seidel"};
  return std::find(keys.begin(), keys.end(), row.info.key) != keys.end();
}

class Mode : public testing::TestWithParam<IterationModeRow> {};

// The infinity norm of M is at most 0.9 * 0.95, so what is left in S is below 1e-9 / (1 - 0.86) of the
// emitted power.
TEST_P(Mode, FindsTheSolutionThatEliminationFinds) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TableSystem system = randomSystem(seed, 20, 3, seed % 2 == 0, 0.95);
    Transport transport = system.transport();
    RadiosityState state(transport, system.emission, system.reflectance);
    const auto mode = GetParam().make();
    ASSERT_GT(solve(*mode, state, transport, 1e-9), 0);
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> exact = system.solution(c);
      const double largest = *std::max_element(exact.begin(), exact.end());
      for (std::size_t q = 0; q < exact.size(); ++q)
        EXPECT_NEAR(state.shot()[q][c], exact[q], 1e-5 * largest);
    }
  }
}

// Three rooms that do not see each other, one of them dark.
TEST_P(Mode, LeavesWhatNoLightReachesExactlyDark) {
  TableSystem system = randomSystem(9, 12, 2, false, 0.95);
  for (std::size_t v = 0; v < system.k.size(); ++v) {
    for (std::size_t q = 0; q < 12; ++q) {
      if (v / 2 % 3 != q % 3) system.k[v][q] = 0;
    }
  }
  for (std::size_t q = 0; q < 12; ++q)
    system.emission[q] = q % 3 == 1 ? glm::dvec3(1, 2, 3) : glm::dvec3(0.0);
  Transport transport = system.transport();
  RadiosityState state(transport, system.emission, system.reflectance);
  const auto mode = GetParam().make();
  for (int k = 0; k < 500; ++k) mode->step(state, transport);
  for (std::size_t v = 0; v < system.k.size(); ++v) {
    if (v / 2 % 3 == 1) continue;
    EXPECT_EQ(state.irradiance()[v], glm::dvec3(0.0));
  }
}

TEST_P(Mode, HasNothingToShootWithoutLight) {
  TableSystem system = randomSystem(10, 6, 2, false, 0.9);
  std::fill(system.emission.begin(), system.emission.end(), glm::dvec3(0.0));
  Transport transport = system.transport();
  RadiosityState state(transport, system.emission, system.reflectance);
  EXPECT_FALSE(GetParam().make()->step(state, transport).has_value());
  EXPECT_EQ(system.calls->columns, 0);
}

TEST_P(Mode, NeverAsksForAColumnThatCarriesNothing) {
  TableSystem system = randomSystem(11, 10, 2, false, 0.9);
  for (std::size_t q = 0; q < 10; ++q) {
    if (q != 2)
      system.reflectance[q] = system.emission[q] = glm::dvec3(0.0);  // all black but one, which emits
  }
  system.emission[2] = glm::dvec3(1.0);
  Transport transport = system.transport();
  RadiosityState state(transport, system.emission, system.reflectance);
  const auto mode = GetParam().make();
  for (int k = 0; k < 50; ++k) mode->step(state, transport);
  EXPECT_EQ(system.calls->columns, 1);
}

TEST_P(Mode, GoesOnFromWhereAnotherStopped) {
  const TableSystem system = randomSystem(12, 20, 3, true, 0.95);
  for (const IterationModeRow& first : iterationModes()) {
    Transport transport = system.transport();
    RadiosityState state(transport, system.emission, system.reflectance);
    const auto before = first.make(), after = GetParam().make();
    for (int k = 0; k < 7; ++k) before->step(state, transport);
    ASSERT_GT(solve(*after, state, transport, 1e-9), 0);
    const std::vector<double> exact = system.solution(1);
    for (std::size_t q = 0; q < exact.size(); ++q) EXPECT_NEAR(state.shot()[q].y, exact[q], 1e-6);
  }
}

// Two patches that see each other, in numbers that are exact in binary: as soon as both emitters have shot,
// H_d is K E to the last bit, whatever mode began and whichever goes on.
TEST_P(Mode, HasAllDirectLightOnceEveryEmitterHasShot) {
  TableSystem system = randomSystem(18, 2, 3, false, 0.75);
  system.emission = {glm::dvec3(1, 2, 0.5), glm::dvec3(4, 0, 8)};
  system.reflectance.assign(2, glm::dvec3(0.5));
  for (const IterationModeRow& first : iterationModes()) {
    for (int before = 0; before <= 3; ++before) {
      Transport transport = system.transport();
      RadiosityState state(transport, system.emission, system.reflectance);
      const auto begun = first.make(), gone_on = GetParam().make();
      for (int k = 0; k < before; ++k) begun->step(state, transport);
      for (int k = 0; k < 20; ++k) gone_on->step(state, transport);
      for (std::size_t v = 0; v < system.k.size(); ++v) {
        const glm::dvec3 all = system.k[v][0] * system.emission[0] + system.k[v][1] * system.emission[1];
        EXPECT_EQ(state.direct()[v], all) << first.info.key << " " << before;
        const glm::dvec3 indirect = system.k[v][0] * (state.shot()[0] - system.emission[0]) +
                                    system.k[v][1] * (state.shot()[1] - system.emission[1]);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(state.direct()[v][c] + indirect[c], state.irradiance()[v][c], 1e-13);
      }
    }
  }
}

// With U >= 0 at the start, shooting U keeps it so, and S grows towards the solution from below.
TEST_P(Mode, ApproachesTheSolutionFromBelow) {
  if (!shootsPatchByPatch(GetParam())) GTEST_SKIP() << "its U takes both signs";
  const TableSystem system = randomSystem(13, 20, 3, false, 0.95);
  Transport transport = system.transport();
  RadiosityState state(transport, system.emission, system.reflectance);
  const std::vector<double> exact = system.solution(2);
  const auto mode = GetParam().make();
  for (int k = 0; k < 300; ++k) {
    mode->step(state, transport);
    for (std::size_t q = 0; q < exact.size(); ++q) {
      EXPECT_GE(state.unshot()[q].z, -1e-12);
      EXPECT_LE(state.shot()[q].z, exact[q] + 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Mode, testing::ValuesIn(iterationModes().begin(), iterationModes().end()),
                         [](const auto& row) {
                           std::string name(row.param.info.key);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Modes, AgreeWithEachOther) {
  const TableSystem system = randomSystem(14, 30, 2, true, 0.95);
  std::vector<std::vector<glm::dvec3>> solutions;
  for (const IterationModeRow& row : iterationModes()) {
    Transport transport = system.transport();
    RadiosityState state(transport, system.emission, system.reflectance);
    const auto mode = row.make();
    ASSERT_GT(solve(*mode, state, transport, 1e-9), 0) << row.info.key;
    solutions.push_back(state.irradiance());
  }
  for (const auto& other : solutions) {
    for (std::size_t v = 0; v < other.size(); ++v) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(other[v][c], solutions[0][v][c], 1e-5 * solutions[0][v][c]);
    }
  }
}

TEST(Southwell, ShootsTheBrightestFirst) {
  const TableSystem system = randomSystem(15, 20, 2, false, 0.9);
  Transport transport = system.transport();
  RadiosityState state(transport, system.emission, system.reflectance);
  const auto mode = makeSouthwell();
  for (int k = 0; k < 100; ++k) {
    const auto power = [&](std::uint32_t q) {
      const glm::dvec3 u = glm::abs(state.unshot()[q]);
      return state.area()[q] * (u.x + u.y + u.z);
    };
    double most = 0;
    for (std::uint32_t q = 0; q < 20; ++q) most = std::max(most, power(q));
    const std::vector<glm::dvec3> before = state.unshot();
    const std::vector<glm::dvec3> shot = state.shot();
    ASSERT_EQ(mode->step(state, transport), 1u);
    const auto shooter = static_cast<std::size_t>(
        std::mismatch(shot.begin(), shot.end(), state.shot().begin()).first - shot.begin());
    const glm::dvec3 u = glm::abs(before[shooter]);
    EXPECT_EQ(state.area()[shooter] * (u.x + u.y + u.z), most);
  }
}

// Rows that sum to 1 and one rho, E: a closed furnace, B = E / (1 - rho). All values are exact in binary, so
// only the sums' rounding is left.
TEST(Jacobi, HasTheErrorRhoToThePowerOfItsSweepsInAFurnace) {
  TableSystem system = randomSystem(16, 24, 2, false, 1);
  const double rho = 0.75, emission = 0.25;
  std::fill(system.reflectance.begin(), system.reflectance.end(), glm::dvec3(rho));
  std::fill(system.emission.begin(), system.emission.end(), glm::dvec3(emission));
  Transport transport = system.transport();
  RadiosityState state(transport, system.emission, system.reflectance);
  const auto mode = makeJacobi();
  for (int sweep = 1; sweep <= 60; ++sweep) {
    for (std::uint32_t k = 0; k < 24; ++k) EXPECT_EQ(mode->step(state, transport), 1u);
    const double expected = std::pow(rho, sweep + 1);
    for (const glm::dvec3& h : state.irradiance()) {
      const double error = 1 - (emission + rho * h.x) / (emission / (1 - rho));
      EXPECT_NEAR(error, expected, 1e-9 * expected + 1e-14) << "sweep " << sweep;
    }
  }
}

TEST(GaussSeidel, TakesFewerSweepsThanJacobi) {
  const TableSystem system = randomSystem(17, 30, 2, false, 0.98);
  const auto shots = [&](const auto& make) {
    Transport transport = system.transport();
    RadiosityState state(transport, system.emission, system.reflectance);
    const auto mode = make();
    return solve(*mode, state, transport, 1e-8);
  };
  const int jacobi = shots(makeJacobi), gauss_seidel = shots(makeGaussSeidel);
  ASSERT_GT(jacobi, 0);
  ASSERT_GT(gauss_seidel, 0);
  EXPECT_LT(gauss_seidel, 0.75 * jacobi);
}

}  // namespace
}  // namespace unshot
