// What the eye meets along a ray, as pictures show it, and what the plan decided there.
#include "session/pick.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <map>

#include "mesh/build.h"
#include "render/camera.h"
#include "session/solve.h"
#include "support/dice.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;
using testing::ElementsAre;
using testing::IsEmpty;

/// Whether a display triangle of the element has the point.
bool elementHas(const Mesh& mesh, std::uint32_t element, const glm::dvec3& point) {
  for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t) {
    if (mesh.triangle_element[t] != element) continue;
    glm::dvec3 corner[3];
    for (std::uint32_t k = 0; k < 3; ++k)
      corner[k] = glm::dvec3(mesh.vertices[mesh.triangle_vertices[3 * t + k]].position);
    const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
      return glm::length(glm::cross(b - a, c - a)) / 2;
    };
    const double whole = area(corner[0], corner[1], corner[2]);
    double parts = 0;
    for (int k = 0; k < 3; ++k) parts += area(point, corner[k], corner[(k + 1) % 3]);
    // Vertices are in single precision.
    if (parts <= whole * (1 + 1e-4)) return true;
  }
  return false;
}

std::vector<std::string_view> keysOf(const std::vector<PickedDecision>& decisions) {
  std::vector<std::string_view> out;
  for (const PickedDecision& d : decisions) out.push_back(d.key);
  return out;
}

// A closed room [0, 1]^3 with light, and apart from it a plate in the dark.
Scene roomAndPlate() {
  SceneBuilder b;
  const auto wall = b.material("wall", glm::dvec3(0.5)),
             light = b.material("light", glm::dvec3(0.5), glm::dvec3(1));
  const auto plate = b.material("plate", glm::dvec3(0.8));
  addBox(b, {wall, wall, wall, light, wall, wall}, {0, 0, 0}, {1, 1, 1}, true);
  b.quad(plate, {3, 0, 0}, {1, 0, 0}, {0, 1, 0});
  return b.finish();
}

Bounds boundsOf(const Mesh& mesh) { return {mesh.bounds_min, mesh.bounds_max}; }

TEST(Pick, FindsTheElementUnderEachPixelOfTheCornellBox) {
  const Mesh mesh = buildMesh(publishedCornellBox(), {2000, {}, false});
  // The camera of the published measurements, 39.3 degrees wide, square.
  Camera camera;
  camera.eye = glm::dvec3(278, 273, -800) - mesh.frame_origin;
  camera.at = glm::dvec3(278, 273, 0) - mesh.frame_origin;
  camera.fov_deg = 39.3;
  Dice dice(3);
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    const double x = dice.between(0.03, 0.97), y = dice.between(0.03, 0.97);  // the box fills 0.022 to 0.978
    const glm::dvec2 at(x, y);
    const auto pick = pickAlong(mesh, camera.eye, sightAt(camera, 1, boundsOf(mesh), at).along);
    ASSERT_TRUE(pick) << at.x << ", " << at.y;
    EXPECT_LT(glm::dot(pick->normal, pick->position - camera.eye), 0);
    const auto back = placeInPicture(camera, 1, pick->position);
    ASSERT_TRUE(back);
    EXPECT_LT(glm::length(*back - at), 1e-9);
    ASSERT_NE(pick->element, kNone);
    EXPECT_EQ(mesh.element_side[pick->element], pick->side);
    EXPECT_EQ(mesh.element_patch[pick->element], pick->patch);
    EXPECT_EQ(mesh.sides[pick->side].surface, pick->surface);
    found += elementHas(mesh, pick->element, pick->position);
  }
  EXPECT_EQ(found, 300);
  // The middle of the floor's front edge: y = 0 in the file.
  const auto floor = pickAlong(mesh, camera.eye, sightAt(camera, 1, boundsOf(mesh), {0.5, 0.96}).along);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->position.y + mesh.frame_origin.y, 0, 1e-9);
  EXPECT_LT(glm::length(floor->normal - glm::dvec3(0, 1, 0)), 1e-9);
}

TEST(Pick, LooksThroughDarkBacksAndStopsAtWhatIsDarkOnBothSides) {
  const Mesh mesh = buildMesh(roomAndPlate(), {600, {}, false});
  const auto from = [&](const glm::dvec3& eye, const glm::dvec3& direction) {
    return pickAlong(mesh, eye - mesh.frame_origin, direction);
  };
  const auto inside = from({0.5, 0.5, -5}, {0, 0, 1});
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->position.z + mesh.frame_origin.z, 1, 1e-12) << "not the wall in front";
  EXPECT_NE(inside->side, kNone);
  for (const double z : {-5.0, 5.0}) {
    const auto plate = from({3.4, 0.3, z}, {0, 0, z < 0 ? 1 : -1});
    ASSERT_TRUE(plate);
    EXPECT_EQ(mesh.materials[mesh.surfaces[plate->surface].material].name, "plate");
    EXPECT_EQ(plate->back, z < 0);
    EXPECT_EQ(plate->side, kNone);
    EXPECT_EQ(plate->element, kNone);
    EXPECT_EQ(plate->patch, kNone);
  }
  EXPECT_FALSE(from({3.4, 0.3, 5}, {0, 0, 1})) << "it looks away";
  EXPECT_FALSE(from({2, 0.5, -5}, {0, 0, 1})) << "between the two";
}

TEST(Pick, AnEdgeBetweenTrianglesHasNoGap) {
  SceneBuilder b;
  const auto m = b.material("m", glm::dvec3(0.5), glm::dvec3(1));
  const std::vector<glm::dvec3> ring{{0, 0, 0}, {1, 0.1, 0}, {0.9, 1, 0}, {-0.2, 0.8, 0}};
  for (std::size_t k = 0; k < 4; ++k) b.polygon(m, {ring[k], ring[(k + 1) % 4], {0.41, 0.47, 0}});
  const Mesh mesh = buildMesh(b.finish(), {100, {}, false});
  Dice dice(1);
  for (int k = 0; k < 2000; ++k) {
    const glm::dvec3 edge = glm::dvec3(0.41, 0.47, 0) - ring[static_cast<std::size_t>(k) % 4];
    const glm::dvec3 target =
        ring[static_cast<std::size_t>(k) % 4] + dice.between(0.01, 1) * edge - mesh.frame_origin;
    const glm::dvec3 eye{dice.between(-3, 3), dice.between(-3, 3), dice.between(0.5, 3)};
    EXPECT_TRUE(pickAlong(mesh, eye, glm::normalize(target - eye))) << k;
  }
}

TEST(Pick, OutlineOfAPatchEnclosesIt) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 0.5), {600, {}, false});
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    double area = 0;
    for (const std::uint32_t e : elementsOf(mesh, q)) area += mesh.element_area[e];
    EXPECT_NEAR(area, mesh.patch_area[q], 1e-9 * area);
    // Around a rectangle of whole cells: twice the area by Green's formula, from edges in any direction.
    const glm::dvec3 normal = mesh.sides[mesh.patch_side[q]].normal;
    const auto outline = patchOutline(mesh, q);
    glm::dvec3 middle(0.0);
    for (const auto& [a, b] : outline)
      middle += glm::dvec3(a + b) / (2.0 * static_cast<double>(outline.size()));
    double enclosed = 0;
    for (const auto& [a, b] : outline) {
      enclosed += std::abs(glm::dot(normal, glm::cross(glm::dvec3(a) - middle, glm::dvec3(b) - middle))) / 2;
    }
    EXPECT_NEAR(enclosed, mesh.patch_area[q], 1e-5 * enclosed) << q;
  }
}

TEST(Pick, SaysWhatThePlanDecided) {
  SolveOptions options;
  options.elements = 600;
  options.form_factors = "rays";
  const Solve solve(roomAndPlate(), options, {});
  const Mesh& mesh = solve.mesh();
  const auto decided = [&](const glm::dvec3& eye, const glm::dvec3& direction) {
    const auto pick = pickAlong(mesh, eye - mesh.frame_origin, direction);
    return pick ? keysOf(decisionsFor(mesh, *pick, solve.plan())) : std::vector<std::string_view>{"nothing"};
  };
  EXPECT_THAT(decided({0.5, 0.5, 0.5}, {0, 0, 1}), ElementsAre(plan_keys::kOuterSides, plan_keys::kOccluders,
                                                               plan_keys::kEscape, plan_keys::kChannels))
      << "the first of its other side";
  EXPECT_THAT(decided({3.4, 0.3, 5}, {0, 0, -1}), ElementsAre(plan_keys::kDarkSides, plan_keys::kOuterSides))
      << "of both sides: in front of one lies the room";
  const auto pick = pickAlong(mesh, glm::dvec3(0.5, 0.5, 0.5) - mesh.frame_origin, {0, 0, 1});
  ASSERT_TRUE(pick);
  EXPECT_THAT(decisionsFor(mesh, *pick, {}), testing::SizeIs(1)) << "sides tell of themselves";
}

TEST(Pick, SaysWhereAMeshThatFollowsTheLightIsFine) {
  SolveOptions options;
  options.form_factors = "rays";
  options.error = 0.01;
  const Solve solve(blockOnFloor(0.4), options, {});
  const Mesh& mesh = solve.mesh();
  ASSERT_TRUE(mesh.base);
  std::set<std::string> texts;
  Dice dice(5);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 eye =
        glm::dvec3(dice.between(0.1, 3.9), 0.5, dice.between(0.1, 3.9)) - mesh.frame_origin;
    const auto pick = pickAlong(mesh, eye, {0, -1, 0});
    if (!pick || pick->element == kNone) continue;
    const auto decisions = decisionsFor(mesh, *pick, solve.plan());
    const auto of = std::count(mesh.element_from_base.begin(), mesh.element_from_base.end(),
                               mesh.element_from_base[pick->element]);
    for (const PickedDecision& d : decisions) {
      if (d.key != plan_keys::kEvenLight) continue;
      texts.insert(d.text.substr(0, 8));
      EXPECT_EQ(d.text.starts_with("A coarse"), of == 1);
    }
  }
  EXPECT_EQ(texts, (std::set<std::string>{"A coarse", "A fine e"}));
}

// What the plan decided where the ray meets something, by key.
std::map<std::string_view, std::string> decidedAt(const Solve& solve, const glm::dvec3& eye,
                                                  const glm::dvec3& direction) {
  std::map<std::string_view, std::string> out;
  const auto pick = pickAlong(solve.mesh(), eye - solve.mesh().frame_origin, direction);
  if (!pick) return out;
  for (const PickedDecision& d : decisionsFor(solve.mesh(), *pick, solve.plan())) out[d.key] = d.text;
  return out;
}

// A grey room [0, 4] x [0, 3] x [0, 4] in which a block hangs, under a ceiling that shines.
Scene roomWithABlock(const glm::dvec3& emission = glm::dvec3(1)) {
  SceneBuilder b;
  const auto wall = b.material("wall", glm::dvec3(0.5, 0.6, 0.7)),
             light = b.material("light", glm::dvec3(0.5), emission);
  addBox(b, {wall, wall, wall, light, wall, wall}, {0, 0, 0}, {4, 3, 4}, true);
  addBox(b, allOf(wall), {1.5, 1, 1.5}, {1, 1, 1}, false);
  return b.finish();
}

SolveOptions byRays(double error) {
  SolveOptions options;
  options.form_factors = "rays";
  options.error = error;
  return options;
}

TEST(Pick, SaysWhichSurfacesNoShadowRayAsksFor) {
  const Solve solve(roomWithABlock(), byRays(0.1), {});
  const glm::dvec3 eye(2, 0.5, 2);
  const auto floor = decidedAt(solve, eye, {0, -1, 0}), block = decidedAt(solve, eye, {0, 1, 0});
  EXPECT_EQ(floor.count(plan_keys::kOccluders), 1u);
  EXPECT_EQ(block.count(plan_keys::kOccluders), 0u) << "it stands between floor and ceiling";
  SolveOptions options = byRays(0.1);
  options.do_anyway = {std::string(plan_keys::kOccluders)};
  const Solve with(roomWithABlock(), options, {});
  EXPECT_EQ(decidedAt(with, eye, {0, -1, 0}).count(plan_keys::kOccluders), 0u);
}

TEST(Pick, SaysThatNoLightEscapes) {
  const glm::dvec3 eye(2, 0.5, 2);
  EXPECT_EQ(decidedAt(Solve(roomWithABlock(), byRays(0.1), {}), eye, {0, -1, 0}).count(plan_keys::kEscape),
            1u);
  SolveOptions options = byRays(0.1);
  options.do_anyway = {std::string(plan_keys::kEscape)};
  EXPECT_EQ(decidedAt(Solve(roomWithABlock(), options, {}), eye, {0, -1, 0}).count(plan_keys::kEscape), 0u);
}

TEST(Pick, SaysWhyFewerChannelsAreSummed) {
  const auto decided = [](const Scene& scene) {
    return decidedAt(Solve(scene, byRays(0.1), {}), {2, 0.5, 2}, {0, -1, 0});
  };
  const auto green = decided(roomWithABlock({0, 1, 0}));
  ASSERT_EQ(green.count(plan_keys::kChannels), 1u);
  EXPECT_EQ(green.at(plan_keys::kChannels), "Fewer channels are summed: nothing emits red or blue.");
  EXPECT_EQ(decided(roomWithABlock({1, 2, 1})).count(plan_keys::kChannels), 0u);
}

// An open room with a black curtain: where all is closed, every patch has its form factors computed.
TEST(Pick, SaysWhichPatchesNeverShot) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5, 0.6, 0.7)), black = b.material("black", {0, 0, 0}),
             lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(4));
  addBox(b, {grey, grey, grey, grey, grey, kNone}, {0, 0, 0}, {4, 3, 4}, true);
  b.quad(black, {0.1, 0, 0.1}, {0, 2.9, 0}, {0, 0, 3.8});
  b.quad(lamp, {2, 2.9, 1}, {1, 0, 0}, {0, 0, 1});
  Solve solve(b.finish(), byRays(0.05), {});
  const Mesh& mesh = solve.mesh();
  const auto idle = [&](std::uint32_t patch) -> std::string {
    Pick pick;
    pick.patch = patch;
    pick.side = mesh.patch_side[patch];
    pick.surface = mesh.sides[pick.side].surface;
    pick.back = mesh.sides[pick.side].back;
    for (const PickedDecision& d : decisionsFor(mesh, pick, solve.plan()))
      if (d.key == plan_keys::kShooters) return d.text;
    return {};
  };
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) EXPECT_EQ(idle(q), "") << "it is not known yet";
  while (solve.state() == SolveState::kRunning) solve.step();
  ASSERT_EQ(solve.state(), SolveState::kConverged);
  std::size_t faint = 0, of_black = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const std::string text = idle(q),
                      material =
                          mesh.materials[mesh.surfaces[mesh.sides[mesh.patch_side[q]].surface].material].name;
    EXPECT_FALSE(material == "lamp" && !text.empty());
    EXPECT_EQ(material == "black", text.ends_with("it is black."));
    of_black += material == "black";
    faint += text.find("mattered") != std::string::npos;
  }
  EXPECT_GT(of_black, 0u);
  EXPECT_GT(faint, 0u);
  EXPECT_EQ(of_black + faint + solve.measures().rows, mesh.patch_count);
}

}  // namespace
}  // namespace unshot
