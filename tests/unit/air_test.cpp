// Which patches face the same air, as the mesh alone shows it.
#include "mesh/air.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <set>

#include "mesh/build.h"
#include "support/dice.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

Mesh meshed(const Scene& scene, std::uint64_t elements) {
  MeshOptions options;
  options.elements = elements;
  options.dark_sides = true;  // dark rooms too
  return buildMesh(scene, options);
}

// The airs of those patches that `counts` lets pass, given a point right before each of their elements (in
// the scene's coordinates) and the side.
using Where = std::function<bool(const glm::dvec3& before, const Side& side)>;
std::set<std::uint32_t> airsOf(const Mesh& mesh, const Where& counts) {
  std::set<std::uint32_t> found;
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const glm::dvec3 centre =
        mesh.shapes[mesh.surfaces[side.surface].elements.first + e - side.first_element].centre;
    if (counts(centre + 1e-3 * side.normal + mesh.frame_origin, side))
      found.insert(mesh.patch_air[mesh.element_patch[e]]);
  }
  return found;
}

bool apart(const std::set<std::uint32_t>& a, const std::set<std::uint32_t>& b) {
  for (const std::uint32_t air : a) {
    if (b.count(air) != 0) return false;
  }
  return !a.empty() && !b.empty();
}

TEST(Air, OfAClosedRoomIsOne) {
  for (const std::uint64_t elements : {6u, 100u, 3000u}) {
    EXPECT_EQ(airsOf(meshed(furnaceScene(0.5, 1), elements), [](auto&&...) { return true; }).size(), 1u);
    const auto inside = [](const glm::dvec3& p, const Side&) {
      return p.x > 0 && p.y > 0 && p.y < 1 && p.z > 0 && ((p.x < 2 && p.z < 1) || (p.x < 1 && p.z < 2));
    };
    EXPECT_EQ(airsOf(meshed(lShapedRoom(), elements), inside).size(), 1u);
  }
}

TEST(Air, OfRoomsWithAWallBetweenIsNotJoined) {
  for (const std::uint64_t elements : {20u, 600u, 5000u}) {
    const Mesh mesh = meshed(litAndDarkRoom(), elements);
    const auto room = [](double low) {
      return [low](const glm::dvec3& p, const Side& side) {
        return side.emission == glm::dvec3(0.0) && p.x > low && p.x < low + 1 && p.y > 0 && p.y < 1 &&
               p.z > 0 && p.z < 1 && !(std::abs(p.y - 0.9) < 0.01);
      };
    };
    const std::set<std::uint32_t> lit = airsOf(mesh, room(0)), dark = airsOf(mesh, room(1));
    EXPECT_EQ(lit.size(), 1u);
    EXPECT_EQ(dark.size(), 1u);
    EXPECT_TRUE(apart(lit, dark));
  }
}

// One floor, one ceiling and side walls that run through; the wall between ends on all of them, at an angle
// that fits no cell.
Scene dividedHall(double slant) {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(0.8));
  addBox(b, allOf(white), {0, 0, 0}, {3, 1, 1}, true);
  b.quad(white, {1.3, 0, 0}, {0, 1, 0}, {slant, 0, 1});
  return b.finish();
}

TEST(Air, IsNotJoinedThroughAWallThatEndsOnAFloorThatRunsThrough) {
  Dice dice(5);
  for (const double slant : {0.0, 0.2, 0.37}) {
    for (const std::uint64_t elements : {20u, 500u, 4000u}) {
      const glm::dmat3 turn = dice.rotation();
      const Mesh mesh = meshed(moved(dividedHall(slant), turn), elements);
      const auto half = [&](bool far) {
        return [&, far](const glm::dvec3& before, const Side&) {
          const glm::dvec3 p = glm::transpose(turn) * before;
          const bool inside = p.x > 0 && p.x < 3 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1;
          return inside && (p.x > 1.3 + slant * p.z) == far;
        };
      };
      const std::set<std::uint32_t> one = airsOf(mesh, half(false)), other = airsOf(mesh, half(true));
      EXPECT_EQ(one.size(), 1u) << slant << ", " << elements;
      EXPECT_EQ(other.size(), 1u) << slant << ", " << elements;
      EXPECT_TRUE(apart(one, other)) << slant << ", " << elements;
    }
  }
}

TEST(Air, UnderABlockIsNotThatAroundIt) {
  const Mesh mesh = meshed(blockOnFloor(0.3), 2000);
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto inside = [&](const glm::dvec3& p) {
    const glm::dvec2 d(p.x - 2, p.z - 2);
    return std::abs(c * d.x + s * d.y) < 0.7 && std::abs(c * d.y - s * d.x) < 0.45 && p.y > 0 && p.y < 1;
  };
  const auto unlit = [](const Side& side) { return side.emission == glm::dvec3(0.0); };
  const std::set<std::uint32_t> under =
      airsOf(mesh, [&](const glm::dvec3& p, const Side& side) { return unlit(side) && inside(p); });
  const std::set<std::uint32_t> around = airsOf(
      mesh, [&](const glm::dvec3& p, const Side& side) { return unlit(side) && !inside(p) && p.y > 0; });
  EXPECT_EQ(under.size(), 1u);
  EXPECT_EQ(around.size(), 1u);
  EXPECT_TRUE(apart(under, around));
}

TEST(Air, OnTheTwoSidesOfASheetIsNotJoined) {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(0.8));
  b.quad(white, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.quad(white, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  b.quad(white, {0, 0, 2}, {1, 0, 0}, {0, 1, 0});
  const Mesh mesh = meshed(b.finish(), 400);
  const auto facing = [](double low) {
    return [low](const glm::dvec3& p, const Side&) { return p.z > low && p.z < low + 1; };
  };
  EXPECT_TRUE(apart(airsOf(mesh, facing(0)), airsOf(mesh, facing(1))));
}

}  // namespace
}  // namespace unshot
