// A leap against shots one by one, on made-up systems and on the Cornell box.
#include "session/leap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "session/energy.h"
#include "support/plan_pairs.h"
#include "support/table_method.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Of K, which is held in single precision, over some tens of terms.
constexpr double kSingle = 1e-6;

struct LeapingRun {
  TableSystem system = randomSystem(7, 24, 3, true, 0.9);
  Transport transport = system.transport();
  RadiosityState state{transport, system.emission, system.reflectance};
  PatchMatrix matrix{transport.receivers(), transport.patchArea(), std::size_t{1} << 24};

  LeapingRun() {
    transport.watchColumns([this](std::uint32_t q, const Column& column) { matrix.set(q, column); });
  }
  void shoot(std::uint32_t q) {
    const glm::dvec3 d = state.unshot()[q];
    state.shoot(q, d, transport.column(q));
  }
  void leap() {
    Leap leap;
    leap.begin(matrix, state, transport);
    while (leap.running()) leap.advance(state, transport);
  }
};

// Reflectances of 0.9 and row sums of 0.9: 24 bounces are enough for all but a 64th, and each was unshot.
TEST(Leap, SendsWhatIsUnshotBounceAfterBounce) {
  LeapingRun run;
  for (std::uint32_t q = 0; q < run.matrix.size(); ++q) run.shoot(q);
  const double before = run.state.unshotPower();
  const int computed = run.system.calls->columns;
  run.leap();
  EXPECT_EQ(run.system.calls->columns, computed);
  EXPECT_LE(run.state.unshotPower(), before / 64 * (1 + kSingle));
  const EnergyBalance energy = energyOf(run.transport, run.state);
  EXPECT_LE(std::abs(energy.residual()), 1e-12 * energy.size());
  for (int c = 0; c < 3; ++c) {
    const std::vector<double> exact = run.system.solution(c);
    for (std::uint32_t q = 0; q < run.matrix.size(); ++q) {
      const double b = run.state.shot()[q][c] + run.state.unshot()[q][c];
      EXPECT_LE(b, exact[q] * (1 + kSingle));
      EXPECT_GE(run.state.unshot()[q][c], -kSingle * exact[q]);
    }
  }
}

TEST(Leap, LeavesToShotsWhatHasNoColumnOrIsEmission) {
  LeapingRun run;
  std::uint32_t lamp = kNone;
  for (std::uint32_t q = 0; q < run.matrix.size(); q += 2) {
    const bool emits = run.system.emission[q] != glm::dvec3(0.0);
    if (emits && lamp == kNone) {
      lamp = q;
      run.transport.column(q);  // at hand, and not shot along
    } else {
      run.shoot(q);
    }
  }
  const std::vector<glm::dvec3> shot = run.state.shot(), unshot = run.state.unshot();
  const int computed = run.system.calls->columns;
  run.leap();
  EXPECT_EQ(run.system.calls->columns, computed);
  double before = 0, after = 0;
  for (std::uint32_t q = 0; q < run.matrix.size(); ++q) {
    if (q % 2 != 0 || q == lamp) {
      EXPECT_EQ(run.state.shot()[q], shot[q]) << q;
      EXPECT_GE(run.state.unshot()[q].x, unshot[q].x) << q;
    } else {
      before += run.state.area()[q] * (unshot[q].x + unshot[q].y + unshot[q].z);
      const glm::dvec3& left = run.state.unshot()[q];
      after += run.state.area()[q] * (left.x + left.y + left.z);
    }
  }
  EXPECT_LE(after, before / 64 * (1 + kSingle));
}

TEST(Leap, SparesShotsWhereNoModeIsAskedFor) {
  constexpr double kError = 0.05;
  SolveOptions options = soonest(kError);
  options.form_factors = "rays";
  const auto leaping = solved(publishedCornellBox(), options);
  options.mode = "southwell";
  const auto shooting = solved(publishedCornellBox(), options);
  EXPECT_LT(leaping->measures().shots, shooting->measures().shots);
  EXPECT_LE(leaping->measures().solverBound(), leaping->solverTarget());
  // Both are that near to the solution of the same system.
  EXPECT_LE(difference(*leaping, *shooting), leaping->solverTarget() + shooting->solverTarget());
}

}  // namespace
}  // namespace unshot
