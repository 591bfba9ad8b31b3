#include "mesh/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/analytic_scenes.h"
#include "support/dice.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using testing_support::Dice;
using testing_support::moved;
using testing_support::onFloor;

struct Made {
  Mesh mesh;
  SurfaceTopology topology;
};

Made make(const Scene& scene) {
  Made out;
  out.topology = makeSurfaces(scene, weld(scene), true, out.mesh);
  return out;
}

// A row of `count` unit squares along x on the floor, fronts up.
SceneBuilder rowOfSquares(std::uint32_t count) {
  SceneBuilder b;
  b.material("a", glm::dvec3(0.5));
  b.material("b", glm::dvec3(0.4));
  for (std::uint32_t k = 0; k < count; ++k) b.quad(0, onFloor(k, 0), onFloor(0, 1), onFloor(1, 0));
  return b;
}

TEST(Surfaces, JoinCoplanarNeighboursOfOneMaterial) {
  const Made made = make(rowOfSquares(5).finish());
  ASSERT_EQ(made.mesh.surfaces.size(), 1u);
  EXPECT_NEAR(made.mesh.surfaces[0].area, 5, 1e-12);
  EXPECT_EQ(made.mesh.surfaces[0].triangles.count, 10u);
}

TEST(Surfaces, JoinAcrossVerticesThatLieOnAnEdge) {
  SceneBuilder b = rowOfSquares(3);
  b.quad(0, onFloor(0, -1), onFloor(0, 1), onFloor(3, 0));
  const Made made = make(b.finish());
  ASSERT_EQ(made.mesh.surfaces.size(), 1u);
  EXPECT_NEAR(made.mesh.surfaces[0].area, 6, 1e-12);
}

TEST(Surfaces, EndWhereTheMaterialChanges) {
  SceneBuilder b = rowOfSquares(2);
  b.quad(1, onFloor(2, 0), onFloor(0, 1), onFloor(1, 0));
  const Made made = make(b.finish());
  ASSERT_EQ(made.mesh.surfaces.size(), 2u);
  EXPECT_EQ(made.mesh.surfaces[0].material, 0u);
  EXPECT_EQ(made.mesh.surfaces[1].material, 1u);
}

TEST(Surfaces, EndWhereAThirdPolygonStandsOnTheEdge) {
  SceneBuilder b = rowOfSquares(2);
  b.quad(0, onFloor(1, 0), onFloor(0, 1), {0, 1, 0});  // a wall between the two squares
  const Made made = make(b.finish());
  EXPECT_EQ(made.mesh.surfaces.size(), 3u);
}

TEST(Surfaces, EndWhereWindingsDisagree) {
  SceneBuilder b = rowOfSquares(1);
  b.quad(0, onFloor(1, 0), onFloor(1, 0), onFloor(0, 1));  // front down
  const Made made = make(b.finish());
  ASSERT_EQ(made.mesh.surfaces.size(), 2u);
  EXPECT_NEAR(glm::dot(made.mesh.surfaces[0].normal, made.mesh.surfaces[1].normal), -1, 1e-12);
  // They continue each other smoothly, the front of one in the back of the other.
  ASSERT_EQ(made.topology.smooth_pairs.size(), 1u);
  EXPECT_TRUE(made.topology.smooth_pairs[0].flipped);
}

TEST(Surfaces, EndAtAnEdgeOfTheBody) {
  const Made made = make(furnaceScene(0.5, 0.5));
  EXPECT_EQ(made.mesh.surfaces.size(), 6u);
  EXPECT_TRUE(made.topology.smooth_pairs.empty());
  EXPECT_EQ(made.topology.edges.size(), 24u);
}

TEST(Surfaces, DoNotJoinParallelSheetsThatDoNotTouch) {
  SceneBuilder b = rowOfSquares(1);
  b.quad(0, {0, 0.5, 0}, onFloor(0, 1), onFloor(1, 0));
  b.quad(0, onFloor(2, 0), onFloor(0, 1), onFloor(1, 0));
  EXPECT_EQ(make(b.finish()).mesh.surfaces.size(), 3u);
}

TEST(Surfaces, AreSmoothPairsUpToThirtyDegrees) {
  for (const double angle_deg : {10.0, 29.0, 31.0, 60.0}) {
    const double angle = angle_deg * std::acos(-1.0) / 180;
    SceneBuilder b = rowOfSquares(1);
    b.quad(0, onFloor(1, 0), onFloor(0, 1), {std::cos(angle), std::sin(angle), 0});
    const Made made = make(b.finish());
    ASSERT_EQ(made.mesh.surfaces.size(), 2u);
    EXPECT_EQ(made.topology.smooth_pairs.size(), angle_deg < 30 ? 1u : 0u) << angle_deg;
  }
}

TEST(Surfaces, HaveAnOrthonormalChartThatHoldsThem) {
  Dice dice(5);
  for (int k = 0; k < 30; ++k) {
    SceneBuilder b;
    b.material("m", glm::dvec3(0.5));
    b.polygon(0, {onFloor(0, 0), onFloor(0, 2), onFloor(1, 2), onFloor(1, 1), onFloor(3, 1), onFloor(3, 0)});
    const Scene scene = moved(b.finish(), dice.rotation(), dice.between(0.01, 100), dice.inCube(10));
    const Made made = make(scene);
    ASSERT_EQ(made.mesh.surfaces.size(), 1u);
    const Surface& s = made.mesh.surfaces[0];
    const double size = glm::length(s.extent), near = 1e-12 * size;
    EXPECT_NEAR(glm::dot(s.axis_u, s.axis_v), 0, 1e-12);
    EXPECT_NEAR(glm::length(s.axis_u), 1, 1e-12);
    EXPECT_LT(glm::distance(glm::cross(s.axis_u, s.axis_v), s.normal), 1e-12);
    // The chart lies along the edges: the smallest rectangle around the L is 2 x 3 for an area of 4.
    EXPECT_NEAR(s.area / (s.extent.x * s.extent.y), 4.0 / 6, 1e-9);
    double area = 0;
    for (const ChartTriangle& t : made.mesh.triangles) {
      const glm::dvec2 e1 = t.uv[1] - t.uv[0], e2 = t.uv[2] - t.uv[0];
      area += (e1.x * e2.y - e1.y * e2.x) / 2;
      for (int corner = 0; corner < 3; ++corner) {
        EXPECT_LT(glm::distance(s.point(t.uv[corner]), made.mesh.positions[t.position[corner]]), 100 * near);
        EXPECT_TRUE(t.uv[corner].x >= -near && t.uv[corner].y >= -near &&
                    t.uv[corner].x <= s.extent.x + near && t.uv[corner].y <= s.extent.y + near);
      }
    }
    EXPECT_NEAR(area, s.area, 1e-12 * s.area);
  }
}

// All rectangles around a triangle along its edges are of one size.
TEST(Surfaces, OfARightTriangleLieAlongItsLegs) {
  Dice dice(6);
  for (const double skew : {0.0, 0.01}) {  // walls of real rooms are not quite square
    SceneBuilder b;
    b.material("m", glm::dvec3(0.5));
    b.polygon(0, {onFloor(0, 0), onFloor(skew, 3), onFloor(2, 0)});
    const Made made = make(moved(b.finish(), dice.rotation(), 1, dice.inCube(10)));
    ASSERT_EQ(made.mesh.surfaces.size(), 1u);
    const glm::dvec2 size = made.mesh.surfaces[0].extent;
    EXPECT_NEAR(std::max(size.x, size.y), 3, 0.02);
    EXPECT_NEAR(std::min(size.x, size.y), 2, 0.02);
  }
}

// Of a wall that is not quite a rectangle too the smallest one counts.
TEST(Surfaces, LieInTheSmallestRectangle) {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.polygon(0, {onFloor(0, 0), onFloor(0, 5.53), onFloor(5.59, 5.5), onFloor(5.59, 0)});
  const Made made = make(b.finish());
  ASSERT_EQ(made.mesh.surfaces.size(), 1u);
  const glm::dvec2 size = made.mesh.surfaces[0].extent;
  EXPECT_NEAR(size.x * size.y, 5.53 * 5.59, 1e-9);
}

// The outline is what two polygons of the surface do not share: its length is the perimeter, whatever the
// polygons.
TEST(Surfaces, MarkTheirOutline) {
  SceneBuilder b = rowOfSquares(4);
  b.quad(0, onFloor(0, -1), onFloor(0, 1), onFloor(4, 0));
  const Made made = make(b.finish());
  double length = 0;
  for (const ChartTriangle& t : made.mesh.triangles) {
    for (int k = 0; k < 3; ++k) length += t.outline[k] ? glm::distance(t.uv[k], t.uv[(k + 1) % 3]) : 0;
  }
  EXPECT_NEAR(length, 4 + 4 + 2 + 2, 1e-12);
}

TEST(Surfaces, JoinAFineSheetIntoOneWhateverTheOrderOfItsTriangles) {
  std::vector<std::uint32_t> order;
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      b.polygon(0, {onFloor(i, j), onFloor(i, j + 1), onFloor(i + 1, j + 1)});
      b.polygon(0, {onFloor(i, j), onFloor(i + 1, j + 1), onFloor(i + 1, j)});
      order.push_back(static_cast<std::uint32_t>(order.size()));
      order.push_back(static_cast<std::uint32_t>(order.size()));
    }
  }
  const Scene scene = b.finish();
  Dice dice(6);
  for (int k = 0; k < 5; ++k) {
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[dice.below(static_cast<std::uint32_t>(i))]);
    const Made made = make(moved(scene, dice.rotation(), 1, glm::dvec3(0.0), order));
    ASSERT_EQ(made.mesh.surfaces.size(), 1u);
    EXPECT_NEAR(made.mesh.surfaces[0].area, 100, 1e-9);
  }
}

}  // namespace
}  // namespace unshot
