// Which sides light can reach: what closed surfaces keep apart is left out, and nothing else ever is.
#include "mesh/reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "base/cosine_direction.h"
#include "mesh/build.h"
#include "mesh/mesh_rays.h"
#include "support/dice.h"
#include "support/random_scene.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

/// Rooms with boxes, of one grey material and a lamp that shines downwards.
class Rooms {
 public:
  Rooms()
      : grey_(builder_.material("grey", glm::dvec3(0.5))),
        lamp_(builder_.material("lamp", glm::dvec3(0.5), glm::dvec3(1.0))) {}

  /// Without the face `open`, one of kLowX and so on.
  Rooms& box(const glm::dvec3& corner, const glm::dvec3& edges, bool inwards = false, int open = -1) {
    BoxMaterials materials = allOf(grey_);
    if (open >= 0) materials[static_cast<std::size_t>(open)] = kNone;
    addBox(builder_, materials, corner, edges, inwards);
    return *this;
  }
  Rooms& lamp(const glm::dvec3& corner) {
    builder_.quad(lamp_, corner, {0.2, 0, 0}, {0, 0, 0.2});
    return *this;
  }
  Rooms& quad(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    builder_.quad(grey_, corner, u, v);
    return *this;
  }
  Scene scene() { return builder_.finish(); }

 private:
  SceneBuilder builder_;
  std::uint32_t grey_, lamp_;
};

// Faces of a box.
constexpr int kLowX = 0, kHighX = 1, kBottom = 2, kTop = 3;

MeshOptions evenly(std::uint64_t elements) {
  MeshOptions options;
  options.elements = elements;
  return options;
}

// A room of 4 x 3 x 4 that is lit.
Rooms litRoom() { return Rooms().box({0, 0, 0}, {4, 3, 4}, true).lamp({2, 2.9, 2}); }

std::size_t sidesOf(Rooms rooms) { return buildMesh(rooms.scene(), evenly(100)).sides.size(); }

// Six walls from within and both sides of the lamp.
constexpr std::size_t kRoom = 8;

TEST(Reach, LeavesOutTheOutsideOfARoom) { EXPECT_EQ(sidesOf(litRoom()), kRoom); }

TEST(Reach, LeavesOutTheInsideOfWhatIsClosed) {
  EXPECT_EQ(sidesOf(litRoom().box({1, 1, 1}, {1, 0.5, 1})), kRoom + 6);
  // On the floor, with a bottom of its own, which sees nothing either.
  EXPECT_EQ(sidesOf(litRoom().box({1, 0, 1}, {1, 0.5, 1})), kRoom + 5);
}

TEST(Reach, LeavesOutTheInsideOfWhatStandsOnAFloorWithoutABottom) {
  EXPECT_EQ(sidesOf(litRoom().box({1, 0, 1}, {1, 0.5, 1}, false, kBottom)), kRoom + 5);
  // One on the other.
  EXPECT_EQ(sidesOf(litRoom()
                        .box({1, 0, 1}, {1, 0.5, 1}, false, kBottom)
                        .box({1.2, 0.5, 1.2}, {0.5, 0.5, 0.5}, false, kBottom)),
            kRoom + 10);
}

TEST(Reach, LeavesOutRoomsWithoutALight) {
  const auto two = [] { return litRoom().box({6, 0, 0}, {4, 3, 4}, true).box({7, 1, 1}, {1, 1, 1}); };
  EXPECT_EQ(sidesOf(two()), kRoom);
  // And what stands outside.
  EXPECT_EQ(sidesOf(two().box({20, 0, 0}, {1, 1, 1}).quad({30, 0, 0}, {1, 0, 0}, {0, 1, 0})), kRoom);
}

TEST(Reach, LeavesOutWhatIsBehindAWallThatTwoRoomsShare) {
  // The dark room x > 4 ends at the lit one's wall x = 4, edge to edge.
  EXPECT_EQ(sidesOf(litRoom().box({4, 0, 0}, {4, 3, 4}, true, kLowX)), kRoom);
}

// In any of these light may pass, however little: nothing is left out that it may reach.
TEST(Reach, KeepsWhatLightReachesThroughTheSmallestGap) {
  for (const double gap : {1e-4, 1e-2, 0.5}) {
    // The wall that the two rooms share ends below the ceiling.
    Rooms rooms = Rooms()
                      .lamp({2, 2.9, 2})
                      .box({0, 0, 0}, {4, 3, 4}, true, kHighX)
                      .box({4, 0, 0}, {4, 3, 4}, true, kLowX);
    rooms.quad({4, 0, 0}, {0, 3 - gap, 0}, {0, 0, 4});
    // Ceilings and two walls of both are one surface each, as nothing stands between.
    EXPECT_EQ(sidesOf(rooms), 2 + 5 + 2 + 2) << gap;
  }
}

TEST(Reach, KeepsWhatStandsOverAHole) {
  // A floor with a hole under a box without a bottom, a dark cellar below, and a lamp in the cellar.
  const auto house = [](bool hole, double lamp) {
    Rooms rooms;
    rooms.box({0, 0, 0}, {4, 3, 4}, true, kBottom).box({0, -3, 0}, {4, 3, 4}, true, kTop).lamp({2, lamp, 2});
    rooms.box({1, 0, 1}, {1, 0.5, 1}, false, kBottom);
    if (!hole) return rooms.quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    rooms.quad({0, 0, 0}, {0, 0, 1.4}, {4, 0, 0}).quad({0, 0, 1.6}, {0, 0, 2.4}, {4, 0, 0});
    return rooms.quad({0, 0, 1.4}, {0, 0, 0.2}, {1.4, 0, 0}).quad({1.6, 0, 1.4}, {0, 0, 0.2}, {2.4, 0, 0});
  };
  const std::size_t upper = 5 + 1 + 5, lower = 5 + 1, inside = 5;
  EXPECT_EQ(sidesOf(house(false, 2.9)), 2 + upper);
  EXPECT_EQ(sidesOf(house(false, -0.5)), 2 + lower);
  EXPECT_GE(sidesOf(house(true, -0.5)), 2 + lower + inside);
}

TEST(Reach, KeepsTheFloorUnderManyBlocks) {
  // So many that a point of the floor at random is under one of them, and on a carpet half under one.
  Rooms rooms = litRoom();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      rooms.box({0.05 + 1.31 * i, 0, 0.05 + 1.31 * j}, {1.28, 1, 1.28}, false, (i + j) % 2 ? kBottom : -1);
  }
  EXPECT_EQ(sidesOf(rooms), kRoom + 9 * 5);
  Rooms carpet = litRoom().box({1, 0, 1}, {1, 0.5, 1}, false, kBottom);
  EXPECT_GE(sidesOf(carpet.quad({0.5, 0, 1.1}, {0, 0, 0.8}, {1.4, 0, 0})), kRoom + 5 + 1);
}

TEST(Reach, KeepsARoomWhoseFloorShines) {
  // Nearly all of the floor is under a block.
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5)),
             lamp = b.material("lamp", glm::dvec3(0.5), glm::dvec3(1));
  BoxMaterials room = allOf(grey), block = allOf(grey);
  room[kBottom] = lamp;
  block[kBottom] = kNone;
  addBox(b, room, {0, 0, 0}, {4, 3, 4}, true);
  addBox(b, block, {0.01, 0, 0.01}, {3.98, 1, 3.98}, false);
  // And what is within the block, lit by the floor below it.
  EXPECT_EQ(buildMesh(b.finish(), evenly(100)).sides.size(), 6u + 10u);
}

TEST(Reach, KeepsAllWhereSurfacesPassThroughEachOther) {
  // A pipe from a dark cellar into a box without a bottom; a wall that ends in another room.
  Rooms rooms = litRoom().box({0, -3, 0}, {4, 3, 4}, true, kTop).box({1, 0, 1}, {1, 0.5, 1}, false, kBottom);
  rooms.box({1.4, -1, 1.4}, {0.2, 1.2, 0.2}, true, kBottom);
  EXPECT_GE(sidesOf(rooms), kRoom + 5);
}

TEST(Reach, LeavesOutNothingUnderASky) {
  MeshOptions options = evenly(100);
  options.sky = true;
  EXPECT_EQ(buildMesh(litRoom().scene(), options).sides.size(), 14u);
}

// Light followed by rays, in scenes of boxes and loose faces that stand apart, touch or pass through each
// other: it never comes to a side that was left out.
TEST(Reach, HoldsForLightThatIsFollowed) {
  std::size_t left_out = 0, sides = 0, met = 0, of_rooms = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Scene scene = RandomScene(seed).scene();
    const Mesh mesh = buildMesh(scene, evenly(60));
    const MeshRays rays(mesh);
    Dice dice(seed);
    sides += 2 * mesh.surfaces.size();
    left_out += 2 * mesh.surfaces.size() - mesh.sides.size();
    for (const Side& side : mesh.sides) {
      if (side.emission == glm::dvec3(0.0)) continue;
      const Range triangles = mesh.surfaces[side.surface].triangles;
      for (int k = 0; k < 300; ++k) {
        const std::uint32_t t = triangles.first + dice.below(triangles.count);
        // Off the edges: lifted off its plane, a point beside one may lie behind what joins there.
        const double u = dice.between(0.1, 0.8), v = dice.between(0.1, 0.9 - u);
        const glm::dvec2 uv =
            u * mesh.triangles[t].uv[0] + v * mesh.triangles[t].uv[1] + (1 - u - v) * mesh.triangles[t].uv[2];
        glm::dvec3 position = mesh.surfaces[side.surface].point(uv), normal = side.normal;
        of_rooms += side.room > 0;
        for (int bounce = 0; bounce < 6; ++bounce) {
          const auto hit = rays.intersect(rays.rays().lifted(position, normal),
                                          cosineDirection(normal, dice.uniform(), dice.uniform()));
          if (!hit) break;
          ++met;
          ASSERT_NE(hit->side, kNone) << "seed " << seed << ", surface " << hit->surface;
          ASSERT_EQ(mesh.sides[hit->side].room, side.room) << "seed " << seed << ", surface " << hit->surface;
          position = hit->at.position;
          normal = hit->at.normal;
        }
      }
    }
  }
  EXPECT_GT(met, 100'000u);
  EXPECT_GT(of_rooms, 1'000u);
  EXPECT_GT(left_out, sides / 10);
}

// With a wall along the seam of two polygons of the floor it closes nothing: the inside stays, on the safe
// side.
TEST(Reach, LeavesNothingOutOfWhatStandsAlongASeam) {
  const auto onTwoFloors = [](double x, double z) {
    return sidesOf(Rooms()
                       .box({0, 0, 0}, {4, 3, 4}, true, kBottom)
                       .quad({0, 0, 0}, {0, 0, 4}, {2, 0, 0})
                       .quad({2, 0, 0}, {0, 0, 4}, {2, 0, 0})
                       .lamp({1, 2.9, 2})
                       .box({x, 0, z}, {1, 0.5, 1}, false, kBottom));
  };
  EXPECT_EQ(onTwoFloors(2, 1), onTwoFloors(2.5, 1) + 5);
}

bool closed(Rooms rooms, MeshOptions options = evenly(100)) {
  return buildMesh(rooms.scene(), options).closed;
}

TEST(Reach, TellsWhetherLightCanLeave) {
  EXPECT_TRUE(closed(litRoom()));
  // Furniture, and what is closed itself, changes nothing.
  EXPECT_TRUE(closed(litRoom().box({1, 0, 1}, {1, 0.5, 1}, false, kBottom)));
  EXPECT_TRUE(closed(litRoom().box({1, 1, 1}, {1, 0.5, 1})));
  // What stands through a wall joins the sides of the wall: it cannot be told, which is on the safe side.
  EXPECT_FALSE(closed(litRoom().box({3.5, 1, 1}, {1, 0.5, 1})));
  // Without a wall, or with a crack of 1e-4, it leaves, and so it does from a lamp outside.
  EXPECT_FALSE(closed(Rooms().box({0, 0, 0}, {4, 3, 4}, true, kHighX).lamp({2, 2.9, 2})));
  EXPECT_FALSE(closed(Rooms()
                          .box({0, 0, 0}, {4, 3, 4}, true, kHighX)
                          .quad({4, 1e-4, 0}, {0, 3, 0}, {0, 0, 4})
                          .lamp({2, 2.9, 2})));
  EXPECT_FALSE(closed(litRoom().lamp({2, 4, 2})));
  // Two rooms, one of which is open; the light is in the other.
  EXPECT_TRUE(closed(litRoom().box({10, 0, 0}, {4, 3, 4}, true, kHighX)));
}

TEST(Reach, DoesNotTellOfLightThatLeavesWhereItIsNotAsked) {
  for (bool MeshOptions::*option : {&MeshOptions::escape_unknown, &MeshOptions::sky,
                                    &MeshOptions::outer_sides, &MeshOptions::dark_sides}) {
    MeshOptions options = evenly(100);
    options.*option = true;
    EXPECT_FALSE(closed(litRoom(), options));
  }
}

// Rays from lit sides find no way out of what is said to be closed.
TEST(Reach, NoRayLeavesWhatIsClosed) {
  int closed_scenes = 0;
  for (std::uint64_t seed = 1; seed <= 250; ++seed) {
    const Mesh mesh = buildMesh(RandomScene(seed).scene(), evenly(50));
    if (!mesh.closed) continue;
    ++closed_scenes;
    const MeshRays rays(mesh);
    Dice dice(seed);
    for (const Side& side : mesh.sides) {
      if (side.emission == glm::dvec3(0.0)) continue;
      const Range& triangles = mesh.surfaces[side.surface].triangles;
      for (int k = 0; k < 100; ++k) {
        const SceneRays::Triangle& triangle =
            rays.rays().triangle(triangles.first + dice.below(triangles.count));
        // Some steps of a walk.
        glm::dvec3 at = triangle.point(dice.uniform(), dice.uniform()), normal = side.normal;
        for (int step = 0; step < 8; ++step) {
          const auto hit = rays.intersect(rays.rays().lifted(at, normal),
                                          cosineDirection(normal, dice.uniform(), dice.uniform()));
          ASSERT_TRUE(hit) << "scene " << seed;
          at = hit->at.position;
          normal = hit->at.normal;
        }
      }
    }
  }
  EXPECT_GE(closed_scenes, 10);
}

// Of each side of the mesh.
std::vector<std::uint32_t> roomsOf(Rooms rooms) {
  std::vector<std::uint32_t> out;
  for (const Side& side : buildMesh(rooms.scene(), evenly(100)).sides) out.push_back(side.room);
  return out;
}

std::size_t roomCount(Rooms rooms) {
  const std::vector<std::uint32_t> all = roomsOf(std::move(rooms));
  return std::set<std::uint32_t>(all.begin(), all.end()).size();
}

TEST(Reach, TellsRoomsApartThatNoLightJoins) {
  const auto two = [](double gap) {
    return litRoom().box({4 + gap, 0, 0}, {4, 3, 4}, true, gap > 0 ? -1 : kLowX).lamp({6, 2.9, 2});
  };
  for (const double gap : {0.0, 1.0}) {
    const std::vector<std::uint32_t> rooms = roomsOf(two(gap));
    ASSERT_EQ(rooms.size(), 2 * kRoom) << gap;
    // As many sides in either.
    EXPECT_EQ(std::count(rooms.begin(), rooms.end(), rooms[0]), kRoom) << gap;
  }
  // What hangs in one belongs to it.
  EXPECT_EQ(roomCount(two(1).box({1, 1, 1}, {1, 0.5, 1})), 2u);
  // What stands on a floor hides which part of it is where.
  EXPECT_EQ(roomCount(two(1).box({1, 0, 1}, {1, 0.5, 1}, false, kBottom)), 1u);
}

TEST(Reach, TellsNoRoomsApartThatACrackJoins) {
  for (const double gap : {1e-4, 0.5}) {
    Rooms rooms = Rooms()
                      .lamp({2, 2.9, 2})
                      .lamp({6, 2.9, 2})
                      .box({0, 0, 0}, {4, 3, 4}, true, kHighX)
                      .box({4, 0, 0}, {4, 3, 4}, true, kLowX);
    EXPECT_EQ(roomCount(rooms.quad({4, 0, 0}, {0, 3 - gap, 0}, {0, 0, 4})), 1u) << gap;
  }
}

}  // namespace
}  // namespace unshot
