// Which sides have elements where a wall is slightly bent: its outer side has none, whatever little of it
// rises over the rest; but nothing that light may reach is left out.
#include "mesh/kept_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "scene/obj_reader.h"
#include "support/assets.h"

namespace unshot {
namespace {

// A box of 1 m with a lamp in it, whose wall at x = 1 is folded along the diagonal: its corner at (1, 1, 1)
// is moved out by `out`. From outside it is a dent or a ridge, as the diagonal goes. `more`: what else there
// is.
Mesh bentBox(double out, bool other_diagonal, const std::function<void(SceneBuilder&)>& more = {}) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5)),
             lamp = b.material("lamp", glm::dvec3(0), glm::dvec3(5));
  const glm::dvec3 corner(1 + out, 1, 1);
  b.quad(grey, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  b.quad(grey, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  b.quad(grey, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.polygon(grey, {{0, 1, 0}, {1, 1, 0}, corner, {0, 1, 1}});
  b.polygon(grey, {{0, 0, 1}, {0, 1, 1}, corner, {1, 0, 1}});
  if (other_diagonal) {
    b.polygon(grey, {{1, 0, 0}, {1, 0, 1}, corner});
    b.polygon(grey, {{1, 0, 0}, corner, {1, 1, 0}});
  } else {
    b.polygon(grey, {{1, 0, 0}, {1, 0, 1}, {1, 1, 0}});
    b.polygon(grey, {{1, 0, 1}, corner, {1, 1, 0}});
  }
  b.quad(lamp, {0.4, 0.9, 0.4}, {0.2, 0, 0}, {0, 0, 0.2});
  if (more) more(b);
  return buildMesh(b.finish(),
                   {.elements = 100, .element_size = {}, .emit_front_only = true, .dark_sides = true});
}

int outerSides(const Mesh& mesh) {
  int count = 0;
  for (const Surface& s : mesh.surfaces) count += s.outer[0] + s.outer[1];
  return count;
}

constexpr int kWalls = 7;  // of the box, in two parts the one

TEST(KeptSides, NoneOutsideOfABoxThatIsSlightlyBent) {
  for (const bool diagonal : {false, true}) {
    for (const double out : {-0.01, 0.01}) {
      SCOPED_TRACE(std::to_string(out) + (diagonal ? ", the other diagonal" : ""));
      EXPECT_EQ(outerSides(bentBox(out, diagonal)), kWalls);
    }
  }
}

TEST(KeptSides, OfAWallThatIsBentByMoreBoth) {
  int dents = 0;
  for (const bool diagonal : {false, true}) {
    for (const double out : {-0.15, 0.15}) dents += outerSides(bentBox(out, diagonal)) < kWalls;
  }
  EXPECT_GT(dents, 0);
}

// However near it is to the wall: within the dent too.
TEST(KeptSides, WhereAnythingLiesInFrontOfBothParts) {
  for (const bool diagonal : {false, true}) {
    for (const double out : {-0.01, 0.01}) {
      for (const double off : {0.003, 0.02, 1.0}) {
        SCOPED_TRACE(std::to_string(out) + " " + std::to_string(off) +
                     (diagonal ? ", the other diagonal" : ""));
        const Mesh mesh = bentBox(out, diagonal, [&](SceneBuilder& b) {
          const auto lamp = b.material("strip", glm::dvec3(0), glm::dvec3(5));
          // Over the fold, where the wall is at x = 1 or 1 + out / 2.
          const double x = (diagonal ? 1 + out / 2 : 1) + off;
          b.quad(lamp, {x, 0.49, 0.49}, {0, 0, 0.02}, {0, 0.02, 0});
        });
        for (const Surface& s : mesh.surfaces) {
          const bool wall = std::abs(s.normal.x) > 0.9 && s.origin.x > 0.5 && s.area > 0.1;
          const int outside = s.normal.x > 0 ? 0 : 1;
          EXPECT_FALSE(wall && s.outer[outside]);
        }
      }
    }
  }
}

// Its red wall is two triangles.
TEST(KeptSides, TheCornellBoxHasNoneOutside) {
  const Mesh mesh = buildMesh(readObj(testing_support::kCornellBox),
                              {.elements = 100, .element_size = {}, .emit_front_only = true});
  EXPECT_EQ(outerSides(mesh), 7) << "floor, ceiling, back wall, green wall, the red one in two, the lamp";
}

}  // namespace
}  // namespace unshot
