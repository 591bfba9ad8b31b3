// Rows of form factors that are closed.
#include "formfactor/closure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/analytic_scenes.h"
#include "session/scene_plan.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

// Outside of a white room without a front, patches see nothing at all. Its mesh follows the light, so that
// rows are closed by patches.
TEST(Closure, LeavesPatchesAloneThatSeeNothing) {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(1.0)),
             lamp = b.material("lamp", glm::dvec3(0.5), glm::dvec3(10.0));
  addBox(b, {white, white, white, white, white, kNone}, {0, 0, 0}, {2, 2, 2}, true);
  b.quad(lamp, {0.75, 1.99, 0.8}, {0.5, 0, 0}, {0, 0, 0.4});
  SolveOptions options;
  options.form_factors = "rays";
  options.error = 0.02;
  options.emit_front_only = true;
  options.do_anyway = {std::string(plan_keys::kOuterSides)};
  const auto solve = solved(b.finish(), options);
  ASSERT_TRUE(solve->mesh().base);
  EXPECT_EQ(solve->mesh().sides.size(), 12u);
  for (const glm::vec3& h : solve->snapshot().irradiance) ASSERT_TRUE(std::isfinite(h.x));
  EXPECT_LT(std::abs(solve->energy().residual()), 1e-9 * solve->energy().emitted);
}

}  // namespace
}  // namespace unshot
