#include "solver/ambient.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/modes.h"
#include "support/table_method.h"

namespace unshot {
namespace {

using namespace testing_support;

TEST(AmbientTerm, IsExactAtTheStartOfAFurnace) {
  TableSystem system = randomSystem(1, 16, 2, false, 1);
  const glm::dvec3 rho(0.5, 0.75, 0.9), emission(1, 2, 3);
  std::fill(system.reflectance.begin(), system.reflectance.end(), rho);
  std::fill(system.emission.begin(), system.emission.end(), emission);
  Transport transport = system.transport();
  const RadiosityState state(transport, system.emission, system.reflectance);
  for (const glm::dvec3& ambient : AmbientTerm(16).values(state)) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(emission[c] + rho[c] * ambient[c], emission[c] / (1 - rho[c]), 1e-12);
    }
  }
}

// As after an edit: what is taken back goes where it went, and leaves no shade of another colour elsewhere.
TEST(AmbientTerm, IsNoneWhereLightIsTakenBack) {
  TableSystem system = randomSystem(1, 16, 2, false, 1);
  std::fill(system.emission.begin(), system.emission.end(), glm::dvec3(1, 0, 3));
  system.emission[5] = {1, -0.1, 3};
  Transport transport = system.transport();
  const RadiosityState state(transport, system.emission, system.reflectance);
  for (const glm::dvec3& ambient : AmbientTerm(16, std::vector<std::uint32_t>(16, 0)).values(state))
    EXPECT_EQ(ambient, glm::dvec3(0.0));
}

// Two rooms of 8 patches; only the first has light.
void feed(AmbientTerm& ambient, Transport& transport) {
  transport.watchColumns(
      [&](std::uint32_t q, const Column& column) { ambient.sees(q, column, transport.receivers()); });
}

class TwoRooms : public testing::Test {
 protected:
  TwoRooms() : system_(randomSystem(2, 16, 2, true, 0.9)) {
    for (std::size_t v = 0; v < system_.k.size(); ++v) {
      const PatchShare& share = system_.receivers.shares[system_.receivers.start[v]];
      const bool second = share.patch >= 8;
      // The receivers that patches of different rooms share see nothing.
      const bool between =
          system_.receivers.start[v + 1] - system_.receivers.start[v] == 2 && share.patch % 8 == 7;
      for (std::size_t q = 0; q < 16; ++q) {
        if (between || (q >= 8) != second) system_.k[v][q] = 0;
      }
    }
    for (std::size_t q = 0; q < 16; ++q) system_.emission[q] = q == 3 ? glm::dvec3(5, 4, 3) : glm::dvec3(0.0);
  }

  TableSystem system_;
};

TEST_F(TwoRooms, GetNoneOfEachOthersLight) {
  for (const IterationModeRow& row : iterationModes()) {
    Transport transport = system_.transport();
    RadiosityState state(transport, system_.emission, system_.reflectance);
    AmbientTerm ambient(16);
    feed(ambient, transport);
    const auto mode = row.make();
    for (int k = 0; k < 60; ++k) {
      mode->step(state, transport);
      const std::vector<glm::dvec3> values = ambient.values(state);
      for (std::size_t q = 8; q < 16; ++q)
        EXPECT_EQ(values[q], glm::dvec3(0.0)) << row.info.key << " shot " << k;
      if (k < 5 && row.info.key != "overshoot") {  // which holds less than nothing after it
        EXPECT_GT(values[3].x, 0);
      }
    }
  }
}

// Once all of a room's patches have shot, they hold one estimate: sum A U / sum A / (1 - mean rho).
TEST_F(TwoRooms, AverageOverThoseWhoSeeEachOther) {
  Transport transport = system_.transport();
  RadiosityState state(transport, system_.emission, system_.reflectance);
  AmbientTerm ambient(16);
  for (std::uint32_t q = 0; q < 8; ++q) {
    state.shoot(q, state.unshot()[q], transport.column(q));
    ambient.sees(q, transport.column(q), transport.receivers());
  }
  double power = 0, reflected = 0, area = 0;
  for (std::size_t q = 0; q < 8; ++q) {
    power += state.area()[q] * state.unshot()[q].y;
    reflected += state.area()[q] * state.reflectance()[q].y;
    area += state.area()[q];
  }
  const std::vector<glm::dvec3> values = ambient.values(state);
  for (std::size_t q = 0; q < 8; ++q) EXPECT_NEAR(values[q].y, power / area / (1 - reflected / area), 1e-12);
}

TEST_F(TwoRooms, HaveLessAmbientAsTheirLightIsShot) {
  Transport transport = system_.transport();
  RadiosityState state(transport, system_.emission, system_.reflectance);
  AmbientTerm ambient(16);
  feed(ambient, transport);
  const auto mode = makeSouthwell();
  for (int k = 0; k < 400; ++k) mode->step(state, transport);
  for (const glm::dvec3& value : ambient.values(state)) EXPECT_LT(value.x, 1e-3);
}

TEST(AmbientTermOfWhiteWalls, StaysFinite) {
  TableSystem system = randomSystem(3, 8, 2, false, 1);
  std::fill(system.reflectance.begin(), system.reflectance.end(), glm::dvec3(1.0));
  Transport transport = system.transport();
  const RadiosityState state(transport, system.emission, system.reflectance);
  for (const glm::dvec3& value : AmbientTerm(8).values(state)) EXPECT_LE(value.x, 1000 * 5.0);
}

}  // namespace
}  // namespace unshot
