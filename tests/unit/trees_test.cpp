// Point tree and box tree against looking at everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/box_tree.h"
#include "base/point_tree.h"
#include "support/dice.h"

namespace unshot {
namespace {

using testing_support::Dice;

std::vector<glm::dvec3> somePoints(Dice& dice, std::size_t count) {
  std::vector<glm::dvec3> points;
  for (std::size_t k = 0; k < count; ++k) {
    // Some coincide, and many lie in one plane, as the corners of a scene do.
    if (k > 0 && dice.uniform() < 0.1) {
      points.push_back(points[dice.below(static_cast<std::uint32_t>(k))]);
      continue;
    }
    glm::dvec3 p = dice.inCube(1);
    if (dice.uniform() < 0.5) p.y = 0;
    points.push_back(p);
  }
  return points;
}

double distanceToSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = b - a;
  if (d == glm::dvec3(0.0)) return glm::distance(p, a);
  return glm::distance(p, a + std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) * d);
}

TEST(PointTree, FindsTheSamePointsNearASegmentAsLookingAtAll) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Dice dice(seed);
    const auto points = somePoints(dice, 1 + dice.below(400));
    const PointTree tree(points);
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 a = dice.inCube(1.2), b = k == 0 ? a : dice.inCube(1.2);
      const double distance = dice.between(0, 0.4);
      std::vector<std::uint32_t> found, expected;
      tree.nearSegment(a, b, distance, [&](std::uint32_t p) { found.push_back(p); });
      for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (distanceToSegment(points[p], a, b) <= distance) expected.push_back(p);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << "seed " << seed;
    }
  }
}

TEST(PointTree, FindsPointsOnAnAxisParallelSegmentAtDistanceZero) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {0.5, 0.001, 0}, {2, 0, 0}};
  std::vector<std::uint32_t> found;
  PointTree(points).nearSegment({0, 0, 0}, {1, 0, 0}, 0, [&](std::uint32_t p) { found.push_back(p); });
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(PointTree, KnowsWhetherAPointLiesInFrontOfAPlane) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Dice dice(seed);
    const auto points = somePoints(dice, 1 + dice.below(200));
    const PointTree tree(points);
    for (int k = 0; k < 50; ++k) {
      const glm::dvec3 normal = dice.direction();
      const double offset = dice.between(-2, 2);
      const bool expected = std::any_of(points.begin(), points.end(),
                                        [&](const auto& p) { return glm::dot(normal, p) > offset; });
      EXPECT_EQ(tree.anyInFront({normal, offset}), expected) << "seed " << seed;
      const PointTree::HalfSpace both[] = {{normal, offset}, {dice.direction(), dice.between(-2, 2)}};
      const bool in_both = std::any_of(points.begin(), points.end(), [&](const auto& p) {
        return glm::dot(normal, p) > offset && glm::dot(both[1].normal, p) > both[1].offset;
      });
      EXPECT_EQ(tree.anyInFront(both), in_both) << "seed " << seed;
    }
  }
}

TEST(PointTree, IsEmptyWithoutPoints) {
  const PointTree tree({});
  tree.nearSegment({0, 0, 0}, {1, 0, 0}, 10, [](std::uint32_t) { FAIL(); });
  EXPECT_FALSE(tree.anyInFront({{1, 0, 0}, -10}));
}

TEST(BoxTree, FindsTheSameBoxesAsLookingAtAll) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Dice dice(seed);
    std::vector<Box> boxes;
    const std::uint32_t count = 1 + dice.below(400);
    const auto someBox = [&](double most) {
      const glm::dvec3 low = dice.inCube(1);
      return Box{low, low + glm::dvec3(most * dice.uniform(), most * dice.uniform(), 0)};
    };
    for (std::uint32_t k = 0; k < count; ++k) boxes.push_back(someBox(0.3));
    const BoxTree tree(boxes);
    for (int k = 0; k < 20; ++k) {
      const Box query = k == 0 ? boxes[0] : someBox(0.8);
      std::vector<std::uint32_t> found, expected;
      tree.overlapping(query, [&](std::uint32_t b) { found.push_back(b); });
      for (std::uint32_t b = 0; b < boxes.size(); ++b) {
        if (boxes[b].overlaps(query)) expected.push_back(b);
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << "seed " << seed;
    }
  }
}

TEST(BoxTree, CountsBoxesThatOnlyTouch) {
  const BoxTree tree({{{0, 0, 0}, {1, 1, 1}}, {{1.5, 0, 0}, {2, 1, 1}}});
  std::vector<std::uint32_t> found;
  tree.overlapping({{1, 1, 1}, {1.25, 2, 2}}, [&](std::uint32_t b) { found.push_back(b); });
  EXPECT_EQ(found, std::vector<std::uint32_t>{0});
}

TEST(BoxTree, IsEmptyWithoutBoxes) {
  BoxTree({}).overlapping({{-1, -1, -1}, {1, 1, 1}}, [](std::uint32_t) { FAIL(); });
}

}  // namespace
}  // namespace unshot
