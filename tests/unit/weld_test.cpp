#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scene/analytic_scenes.h"
#include "support/dice.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using testing_support::Dice;
using testing_support::onFloor;

std::vector<glm::dvec3> ringOf(const Scene& scene, const WeldedScene& welded, std::size_t polygon) {
  std::vector<glm::dvec3> out;
  for (const std::uint32_t v : welded.outline(polygon))
    out.push_back(welded.positions[v] + scene.frame_origin);
  return out;
}

TEST(Weld, MakesCoincidingCornersOne) {
  const Scene cube = furnaceScene(0.5, 0.5);
  ASSERT_EQ(cube.positions.size(), 24u);
  const WeldedScene welded = weld(cube);
  EXPECT_EQ(welded.positions.size(), 8u);
  for (std::size_t p = 0; p < 6; ++p) EXPECT_EQ(welded.outline(p).size(), 4u);
  for (std::size_t k = 0; k < cube.positions.size(); ++k) {
    EXPECT_LE(glm::distance(welded.positions[welded.from_scene[k]], cube.positions[k]), weldDistance(cube));
  }
}

TEST(Weld, MakesNearlyCoincidingCornersOneButNoMore) {
  for (const double share : {0.5, 2.0}) {
    const Scene whole = furnaceScene(0.5, 0.5);
    const double gap = share * weldDistance(whole);
    SceneBuilder b;
    const auto m = b.material("m", glm::dvec3(0.5));
    b.quad(m, {0, 0, 0}, {1, 0, 0}, {0, 1, 1});
    b.quad(m, {0, -gap, 0}, {0, 1, 1}, {1, 0, 0});
    EXPECT_EQ(weld(b.finish()).positions.size(), share < 1 ? 4u : 8u);
  }
}

TEST(Weld, PutsVerticesThatLieOnAnEdgeIntoIt) {
  SceneBuilder b;
  const auto m = b.material("m", glm::dvec3(0.5));
  b.polygon(m, {onFloor(0, 0), onFloor(0, 1), onFloor(3, 1), onFloor(3, 0)});
  b.polygon(m, {onFloor(0, 1), onFloor(0, 2), onFloor(1, 2), onFloor(1, 1)});
  b.polygon(m, {onFloor(1, 1), onFloor(1, 2), onFloor(2, 2), onFloor(2, 1)});
  b.polygon(m, {onFloor(2, 1), onFloor(2, 2), onFloor(3, 2), onFloor(3, 1)});
  const Scene scene = b.finish();
  const std::vector<glm::dvec3> ring = ringOf(scene, weld(scene), 0);
  const std::vector<glm::dvec3> expected{onFloor(0, 0), onFloor(0, 1), onFloor(1, 1),
                                         onFloor(2, 1), onFloor(3, 1), onFloor(3, 0)};
  ASSERT_EQ(ring.size(), expected.size());
  for (std::size_t k = 0; k < ring.size(); ++k) EXPECT_LT(glm::distance(ring[k], expected[k]), 1e-12);
}

TEST(Weld, LeavesVerticesBesideAnEdgeAlone) {
  SceneBuilder b;
  const auto m = b.material("m", glm::dvec3(0.5));
  b.quad(m, onFloor(0, 0), onFloor(0, 1), onFloor(2, 0));
  b.quad(m, onFloor(0.5, 1.001), onFloor(0, 1), onFloor(1, 0));  // a gap far above the welding distance
  EXPECT_EQ(weld(b.finish()).outline(0).size(), 4u);
}

TEST(Weld, EmptiesPolygonsThatCollapse) {
  SceneBuilder b;
  const auto m = b.material("m", glm::dvec3(0.5));
  b.quad(m, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.polygon(m, {{0, 0, 0}, {1e-8, 0, 0}, {0, 1e-8, 0}});
  b.polygon(m, {{0, 0, 0}, {1, 0, 0}, {1, 1e-8, 0}});
  const WeldedScene welded = weld(b.finish());
  EXPECT_EQ(welded.outline(0).size(), 4u);
  EXPECT_EQ(welded.outline(1).size(), 0u);
  EXPECT_EQ(welded.outline(2).size(), 0u);
}

TEST(MergePoints, FindsTheFirstPointWithinTheDistanceAsLookingAtAllDoes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Dice dice(seed);
    std::vector<glm::dvec3> points;
    for (int k = 0; k < 300; ++k) {
      const bool near = k > 0 && dice.uniform() < 0.5;
      const glm::dvec3 base = near ? points[dice.below(static_cast<std::uint32_t>(k))] : dice.inCube(1);
      points.push_back(near ? base + dice.inCube(0.02) : base);
    }
    const double distance = 0.01;
    const std::vector<std::uint32_t> merged = mergePoints(points, distance);
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      // Only points that stand for themselves can stand for others: chains are not followed.
      bool possible = false;
      for (std::uint32_t other = 0; other < k; ++other) {
        if (merged[other] == other && glm::distance(points[other], points[k]) <= distance) possible = true;
      }
      EXPECT_EQ(merged[k] != k, possible);
      EXPECT_EQ(merged[merged[k]], merged[k]);
      EXPECT_LE(glm::distance(points[merged[k]], points[k]), distance);
    }
  }
}

}  // namespace
}  // namespace unshot
