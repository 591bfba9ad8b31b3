#include "scene/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

namespace unshot {
namespace {

using Outline = std::vector<glm::dvec2>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr double kPi = 3.14159265358979323846;

double areaOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

double areaOf(const Outline& outline) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) area += areaOf(outline[0], outline[i], outline[i + 1]);
  return area;
}

/// n - 2 triangles with an area each, which add up to the polygon's, and every edge of the outline in exactly
/// one of them.
void expectWhole(const Outline& outline, const std::string& what) {
  SCOPED_TRACE(what);
  const Triangles triangles = triangulate(outline);
  ASSERT_EQ(triangles.size(), outline.size() - 2);
  double sum = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : triangles) {
    const double area = areaOf(outline[t[0]], outline[t[1]], outline[t[2]]);
    EXPECT_GT(area, 0.0);
    sum += area;
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  EXPECT_NEAR(sum, areaOf(outline), 1e-9 * areaOf(outline));
  for (std::uint32_t i = 0; i < outline.size(); ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % outline.size());
    EXPECT_EQ((edges[{i, next}]), 1) << "edge " << i;
  }
}

/// Points on the edges, as neighbours in a mesh leave them: exact, or off by rounding.
Outline withCollinearCorners(const Outline& outline, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    result.push_back(a);
    std::vector<double> cuts(random() % 4);
    for (double& cut : cuts) cut = unit(random);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end(), [](double s, double t) { return t - s < 1e-6; }),
               cuts.end());
    for (const double cut : cuts) result.push_back(a + cut * (b - a));
  }
  return result;
}

Outline moved(const Outline& outline, double scale, double angle, const glm::dvec2& offset) {
  Outline result;
  for (const glm::dvec2& p : outline) {
    const glm::dvec2 turned{std::cos(angle) * p.x - std::sin(angle) * p.y,
                            std::sin(angle) * p.x + std::cos(angle) * p.y};
    result.push_back(scale * (turned + offset));
  }
  return result;
}

Outline star(std::size_t corners, std::mt19937& random) {
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  Outline outline;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(corners);
    outline.push_back(radius(random) * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

/// Teeth that point up from a bar.
Outline comb(std::size_t teeth) {
  Outline outline{{0, 0}, {2.0 * static_cast<double>(teeth), 0}};
  for (std::size_t i = teeth; i-- > 0;) {
    const double x = 2.0 * static_cast<double>(i);
    outline.insert(outline.end(), {{x + 1.5, 1}, {x + 1.5, 8}, {x + 0.5, 8}, {x + 0.5, 1}});
  }
  return outline;
}

/// A band of constant width that winds inwards.
Outline spiral(std::size_t steps) {
  Outline outer, inner;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double angle = 0.3 * static_cast<double>(i);
    const double radius = 1 + 0.1 * angle;
    const glm::dvec2 direction{std::cos(angle), std::sin(angle)};
    outer.push_back((radius + 0.2) * direction);
    inner.push_back(radius * direction);
  }
  Outline outline = outer;
  outline.insert(outline.end(), inner.rbegin(), inner.rend());
  return outline;
}

TEST(Triangulate, KeepsATriangleAsItIs) {
  EXPECT_EQ(triangulate(Outline{{0, 0}, {1, 0}, {0, 1}}), (Triangles{{0, 1, 2}}));
}

TEST(Triangulate, MakesNothingOfFewerThanThreeCorners) {
  EXPECT_TRUE(triangulate(Outline{}).empty());
  EXPECT_TRUE(triangulate(Outline{{0, 0}, {1, 0}}).empty());
}

TEST(Triangulate, MakesNothingOfATriangleWithoutArea) {
  EXPECT_TRUE(triangulate(Outline{{0, 0}, {1, 1}, {2, 2}}).empty());
  EXPECT_TRUE(triangulate(Outline{{1, 1}, {1, 1}, {1, 1}}).empty());
}

TEST(Triangulate, CutsASquareFromItsFirstCorner) {
  EXPECT_EQ(triangulate(Outline{{0, 0}, {1, 0}, {1, 1}, {0, 1}}), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, CutsAKiteAlongTheDiagonalThatGivesTheBetterTriangles) {
  EXPECT_EQ(triangulate(Outline{{-10, 0}, {0, -1}, {10, 0}, {0, 1}}), (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Triangulate, CutsAConcaveQuadAtItsReflexCorner) {
  const Outline arrow{{0, 0}, {2, 1}, {0, 2}, {1, 1}};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    Outline outline = arrow;
    std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(turn), outline.end());
    expectWhole(outline, "turned by " + std::to_string(turn));
  }
}

TEST(Triangulate, KeepsTVerticesAsCornersOfTrianglesWithAnArea) {
  expectWhole({{0, 0}, {1, 0}, {2, 0}, {0, 2}}, "one on an edge");
  expectWhole({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}}, "two on an edge");
  expectWhole({{0, 0}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 1}}, "one on each edge");
  expectWhole({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}},
              "a square with the middles of its edges");
  const double t = 1.0 / 3.0;
  expectWhole({{0, 0}, {0.1 * t, 0.7 * t}, {0.1, 0.7}, {-1, 0.3}}, "off the edge by rounding");
}

TEST(Triangulate, JoinsAHoleThroughABridge) {
  expectWhole({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},
              "a square ring");
}

TEST(Triangulate, JoinsTwoHolesThroughBridgesAtOneCorner) {
  expectWhole({{0, 0},
               {9, 0},
               {9, 4},
               {0, 4},
               {0, 0},
               {1, 1},
               {1, 3},
               {3, 3},
               {3, 1},
               {1, 1},
               {0, 0},
               {5, 1},
               {5, 3},
               {7, 3},
               {7, 1},
               {5, 1}},
              "two square holes");
}

TEST(Triangulate, CoversRandomStarsWithCollinearCorners) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const Outline outline = withCollinearCorners(star(3 + random() % 40, random), random);
    const double scale = std::pow(10.0, 18 * unit(random) - 9);
    expectWhole(moved(outline, scale, 2 * kPi * unit(random), {unit(random), unit(random)}),
                "star " + std::to_string(i));
  }
}

TEST(Triangulate, CoversCombsWithCollinearCorners) {
  std::mt19937 random(2);
  for (std::size_t teeth = 1; teeth < 30; ++teeth) {
    const Outline outline = withCollinearCorners(comb(teeth), random);
    expectWhole(outline, "comb " + std::to_string(teeth));
    expectWhole(moved(outline, 1e-3, 0.1 * static_cast<double>(teeth), {3, 5}), "comb, turned");
  }
}

TEST(Triangulate, CoversSpirals) {
  std::mt19937 random(3);
  for (std::size_t steps = 2; steps < 150; steps += 7) {
    expectWhole(spiral(steps), "spiral " + std::to_string(steps));
    expectWhole(withCollinearCorners(spiral(steps), random), "spiral with collinear corners");
  }
}

TEST(Triangulate, CoversThousandsOfCorners) {
  std::mt19937 random(4);
  expectWhole(star(3000, random), "star");
  expectWhole(comb(700), "comb");
  Outline circle;
  for (int i = 0; i < 2000; ++i) circle.emplace_back(std::cos(kPi * i / 1000), std::sin(kPi * i / 1000));
  expectWhole(circle, "circle");
}

TEST(Triangulate, EndsOnOutlinesThatAreNotSimple) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    Outline outline(4 + random() % 60);
    for (glm::dvec2& p : outline) p = {unit(random), unit(random)};
    if (i % 2 == 0) {
      for (glm::dvec2& p : outline) p = {std::round(3 * p.x), std::round(3 * p.y)};
    }
    const Triangles triangles = triangulate(outline);
    EXPECT_LE(triangles.size(), outline.size() - 2);
    for (const auto& t : triangles) EXPECT_GT(areaOf(outline[t[0]], outline[t[1]], outline[t[2]]), 0.0);
  }
}

TEST(Triangulate, EndsOnOutlinesWithoutAnyArea) {
  EXPECT_TRUE(triangulate(Outline(50, {1, 1})).empty());
  Outline line;
  for (int i = 0; i < 50; ++i) line.emplace_back(i, 2 * i);
  EXPECT_TRUE(triangulate(line).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(triangulate(Outline(20, {nan, nan})).empty());
}

TEST(Triangulate, EndsOnAClockwiseOutline) {
  const Outline outline{{0, 0}, {0, 1}, {1, 2}, {2, 1}, {1, 0}};
  for (const auto& t : triangulate(outline))
    EXPECT_GT(areaOf(outline[t[0]], outline[t[1]], outline[t[2]]), 0.0);
}

TEST(Triangulate, LeavesOutASpike) {
  const Outline outline{{0, 0}, {1, 0}, {3, 0}, {1, 0}, {1, 1}, {0, 1}};
  double area = 0;
  for (const auto& t : triangulate(outline)) {
    EXPECT_GT(areaOf(outline[t[0]], outline[t[1]], outline[t[2]]), 0.0);
    area += areaOf(outline[t[0]], outline[t[1]], outline[t[2]]);
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

}  // namespace
}  // namespace unshot
