// What must not fool the plan: cracks and chips of a ten thousandth of the scene, in scenes from millimetres
// to kilometres.
#include <gtest/gtest.h>

#include <cmath>

#include "formfactor/methods.h"
#include "session/scene_plan.h"
#include "support/plan_pairs.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

constexpr double kSmall = 1e-4;  // of a scene of size 1

enum class Crack { kUnderCeiling, kInTheMiddle, kAlongACorner };

// Rooms x < 0.5 and x > 0.5 of a house of 1 x 0.5 x 0.5, in the first a wall that shines; nothing but a crack
// in the wall between joins them.
Scene crackedHouse(Crack crack) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5)),
             lamp = b.material("lamp", glm::dvec3(0.5), glm::dvec3(1.0));
  BoxMaterials first = allOf(grey), second = allOf(grey);
  first[0] = lamp;
  first[1] = second[0] = kNone;
  addBox(b, first, glm::dvec3(0), glm::dvec3(0.5), true);
  addBox(b, second, {0.5, 0, 0}, glm::dvec3(0.5), true);
  const auto wall = [&](double low_y, double high_y, double low_z, double high_z) {
    b.quad(grey, {0.5, low_y, low_z}, {0, high_y - low_y, 0}, {0, 0, high_z - low_z});
  };
  switch (crack) {
    case Crack::kUnderCeiling:
      wall(0, 0.5 - kSmall, 0, 0.5);
      break;
    case Crack::kInTheMiddle:
      wall(0, 0.5, 0, 0.25);
      wall(0, 0.5, 0.25 + kSmall, 0.5);
      break;
    case Crack::kAlongACorner:
      wall(0, 0.5, kSmall, 0.5);
      break;
  }
  return b.finish();
}

class HostileSize : public testing::TestWithParam<double> {
 protected:
  static Scene sized(const Scene& scene) { return moved(scene, unturned(), GetParam()); }
};

// Rooms behind it are solved, and light comes there. A thousandth of all light passes; what rays find of it
// is left to chance, within the error asked for.
TEST_P(HostileSize, ACrackLetsLightThrough) {
  for (const Crack crack : {Crack::kUnderCeiling, Crack::kInTheMiddle, Crack::kAlongACorner}) {
    SolveOptions options = soonest(0.05);
    options.emit_front_only = true;
    const auto solve = solved(sized(crackedHouse(crack)), options);
    for (const char* key : {"dark-sides", "occlusion"}) EXPECT_EQ(keysOf(*solve).count(key), 0u) << key;
    const Mesh& mesh = solve->mesh();
    const Snapshot snapshot = solve->snapshot();
    double area[2] = {}, power[2] = {};  // of either room [m^2], and what arrives in it [W]
    for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
      const Side& side = mesh.sides[mesh.element_side[e]];
      const std::uint32_t local = e - side.first_element;
      const glm::dvec3 at = mesh.shapes[mesh.surfaces[side.surface].elements.first + local].centre +
                            mesh.frame_origin + 1e-3 * GetParam() * side.normal;
      const int room = at.x > 0.5 * GetParam();
      area[room] += mesh.element_area[e];
      power[room] += mesh.element_area[e] * static_cast<double>(snapshot.element_irradiance[e].x);
    }
    EXPECT_NEAR(area[1] / area[0], 1, 10 * kSmall);
    measured("what arrives behind the crack over what arrives before it", power[1] / power[0]);
    EXPECT_GT(power[1], 0);
    EXPECT_LT(power[1], options.error * power[0]);
  }
}

// B = E / (1 - rho) = 1 in a box that glows; a black chip of an occluder in it changes that by less than can
// be seen, and is no reason to forget that it is there.
TEST_P(HostileSize, AChipIsAnOccluder) {
  for (const glm::dvec3& corner : {glm::dvec3(0.5, 0.3, 0.5), glm::dvec3(0.5, 0, 0.5)}) {
    SceneBuilder b;
    addBox(b, allOf(b.material("glow", glm::dvec3(0.5), glm::dvec3(0.5))), {0, 0, 0}, glm::dvec3(1), true);
    // Upright: one hangs in the air, one stands on the floor.
    b.quad(b.material("chip", glm::dvec3(0.0)), corner, {kSmall, 0, 0}, {0, kSmall, 0});
    SolveOptions options = soonest(0.02);
    options.emit_front_only = true;
    const auto solve = solved(sized(b.finish()), options);
    for (const char* key : {"occlusion", "fineness"}) EXPECT_EQ(keysOf(*solve).count(key), 0u) << key;
    EXPECT_NE(solve->formFactorsKey(), "closed-form");
    const Mesh& mesh = solve->mesh();
    EXPECT_EQ(mesh.sides.size(), 6u + 2);  // of walls and chip
    const Snapshot snapshot = solve->snapshot();
    double power = 0, area = 0;
    for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
      if (!mesh.emits(mesh.element_patch[e])) continue;
      power += mesh.element_area[e] * static_cast<double>(snapshot.element_irradiance[e].x);
      area += mesh.element_area[e];
    }
    EXPECT_NEAR(power / area, 1, options.error);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, HostileSize, testing::Values(1e-3, 1.0, 1e3));

}  // namespace
}  // namespace unshot
