// Point to polygon against published closed forms, quadrature, and the closure of a box.
#include "formfactor/polygon_factor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/dice.h"

namespace unshot {
namespace {

using testing_support::Dice;
using Ring = std::vector<glm::dvec3>;

double factor(const glm::dvec3& point, const glm::dvec3& normal, const Ring& ring) {
  std::vector<glm::dvec3> scratch;
  return pointToPolygonFactor(point, normal, ring, scratch);
}

// The rectangle [x0, x1] x [y0, y1] at height z, seen from below.
Ring ceiling(double x0, double x1, double y0, double y1, double z) {
  return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

double cornerFactor(double x, double y) {
  return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
         (2 * std::numbers::pi);
}

const glm::dvec3 kOrigin(0.0), kUp(0, 0, 1);

TEST(PolygonFactor, EqualsThePublishedValues) {
  EXPECT_NEAR(factor(kOrigin, kUp, ceiling(0, 1, 0, 1, 1)), 0.138531606, 1e-9);
  EXPECT_NEAR(factor(kOrigin, kUp, ceiling(-1, 1, -1, 1, 1)), 0.554126424, 1e-9);
  EXPECT_NEAR(factor(kOrigin, kUp, ceiling(-0.5, 0.5, -0.5, 0.5, 1)), 0.239456470, 1e-9);
}

TEST(PolygonFactor, EqualsTheClosedFormOfRectanglesWithACornerOnTheNormal) {
  Dice dice(1);
  for (int k = 0; k < 200; ++k) {
    const double a = std::exp(dice.between(-4, 4)), b = std::exp(dice.between(-4, 4)),
                 c = dice.between(0.1, 3);
    EXPECT_NEAR(factor(kOrigin, kUp, ceiling(0, a, 0, b, c)), cornerFactor(a / c, b / c), 1e-13);
  }
}

// A disk over the point on its axis: R^2 / (R^2 + h^2). The regular polygon of the same area with n corners
// differs by less than 1 / n^2.
TEST(PolygonFactor, EqualsTheClosedFormOfACoaxialDisk) {
  constexpr int kCorners = 20000;
  const double radius = 0.7, height = 1.3, turn = 2 * std::numbers::pi / kCorners;
  const double outer = radius * std::sqrt(turn / std::sin(turn));
  Ring ring;
  for (int k = kCorners; k-- > 0;)
    ring.emplace_back(outer * std::cos(turn * k), outer * std::sin(turn * k), height);
  EXPECT_NEAR(factor(kOrigin, kUp, ring), radius * radius / (radius * radius + height * height), 2e-9);
}

TEST(PolygonFactor, DoesNotDependOnPlaceOrientationOrScale) {
  Dice dice(2);
  for (int k = 0; k < 100; ++k) {
    const double a = dice.between(0.1, 3), b = dice.between(0.1, 3), c = dice.between(0.1, 3);
    const glm::dmat3 turn = dice.rotation();
    const glm::dvec3 shift = dice.inCube(100);
    const double scale = std::pow(10.0, dice.between(-3, 4));
    Ring ring = ceiling(0, a, 0, b, c);
    for (glm::dvec3& corner : ring) corner = scale * (turn * corner + shift);
    EXPECT_NEAR(factor(scale * shift, turn * kUp, ring), cornerFactor(a / c, b / c), 1e-11);
  }
}

// The midpoint rule over n x n parts of a triangle in general position (some of it below the horizon),
// against its integrand cos cos' / (pi r^2), which is clipped by max(0, .).
TEST(PolygonFactor, EqualsQuadratureOverTiltedTriangles) {
  Dice dice(3);
  for (int k = 0; k < 20; ++k) {
    const glm::dvec3 normal = dice.direction();
    const glm::dvec3 centre = 2.5 * dice.direction();
    Ring ring{centre + dice.inCube(1), centre + dice.inCube(1), centre + dice.inCube(1)};
    glm::dvec3 plane = glm::cross(ring[1] - ring[0], ring[2] - ring[0]);
    if (glm::dot(plane, ring[0]) > 0) {  // seen from the origin it must run counter-clockwise
      std::swap(ring[1], ring[2]);
      plane = -plane;
    }
    constexpr int kParts = 400;
    double sum = 0;
    for (int i = 0; i < kParts; ++i) {
      for (int j = 0; j < kParts - i; ++j) {
        for (int upper = 0; upper < (j < kParts - i - 1 ? 2 : 1); ++upper) {
          const double third = upper ? 2.0 / 3 : 1.0 / 3;
          const double s = (i + third) / kParts, t = (j + third) / kParts;
          const glm::dvec3 p = ring[0] + s * (ring[1] - ring[0]) + t * (ring[2] - ring[0]);
          const double r2 = glm::dot(p, p);
          sum += std::max(0.0, glm::dot(normal, p)) * -glm::dot(plane, p) / (2 * r2 * r2);
        }
      }
    }
    sum /= std::numbers::pi * kParts * kParts;
    EXPECT_NEAR(factor(kOrigin, normal, ring), sum, 1e-5 * std::max(sum, 1e-2));
  }
}

TEST(PolygonFactor, CutsAwayWhatLiesBelowTheHorizon) {
  // A wall that goes as far below the horizon as above counts as its upper half alone.
  const Ring wall{{1, -1, -2}, {1, -1, 2}, {1, 1, 2}, {1, 1, -2}};
  const Ring upper{{1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {1, 1, 0}};
  EXPECT_GT(factor(kOrigin, kUp, upper), 0.05);
  EXPECT_NEAR(factor(kOrigin, kUp, wall), factor(kOrigin, kUp, upper), 1e-15);
  EXPECT_EQ(factor(kOrigin, kUp, ceiling(-1, 1, -1, 1, -0.5)), 0);
  // Touching the horizon with an edge or a corner only.
  EXPECT_NEAR(factor(kOrigin, kUp, {{1, -1, 0}, {1, 1, 0}, {1, 0, -1}}), 0, 1e-15);
}

TEST(PolygonFactor, CutsConcavePolygonsAtTheHorizonToo) {
  // A comb whose two teeth reach above the horizon and whose back lies below it: the sum of the teeth.
  const auto wallPoint = [](double y, double z) { return glm::dvec3(1, y, z); };
  const Ring comb{wallPoint(-1, -1),    wallPoint(-1, 1),  wallPoint(-0.5, 1), wallPoint(-0.5, -0.5),
                  wallPoint(0.5, -0.5), wallPoint(0.5, 1), wallPoint(1, 1),    wallPoint(1, -1)};
  const Ring left{wallPoint(-1, 0), wallPoint(-1, 1), wallPoint(-0.5, 1), wallPoint(-0.5, 0)};
  const Ring right{wallPoint(0.5, 0), wallPoint(0.5, 1), wallPoint(1, 1), wallPoint(1, 0)};
  EXPECT_NEAR(factor(kOrigin, kUp, comb), factor(kOrigin, kUp, left) + factor(kOrigin, kUp, right), 1e-15);
}

TEST(PolygonFactor, IsNotAboveZeroFromBehind) {
  Ring ring = ceiling(-1, 1, -1, 1, 1);
  std::reverse(ring.begin(), ring.end());
  EXPECT_LE(factor(kOrigin, kUp, ring), 0);
}

TEST(PolygonFactor, AddsUpOverTheParts) {
  const Ring whole{{-1, -1, 1}, {-1, 2, 1.5}, {2, 2, 3}, {2, -1, 2.5}};
  const glm::dvec3 middle = (whole[0] + whole[2]) / 2.0;
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += factor(kOrigin, kUp, {whole[k], whole[(k + 1) % 4], middle});
  EXPECT_NEAR(factor(kOrigin, kUp, whole), sum, 1e-14);
}

// Rows of the inside of a box sum to 1 wherever the receiver stands, and however it is turned.
TEST(PolygonFactor, SumsToOneInsideAClosedBox) {
  const auto at = [](double x, double y, double z) { return glm::dvec3(x, y, z); };
  const std::array<Ring, 6> faces = {{{at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0)},
                                      {at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)},
                                      {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)},
                                      {at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)},
                                      {at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)},
                                      {at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}}};
  Dice dice(4);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 point = glm::dvec3(0.5) + dice.inCube(0.49), normal = dice.direction();
    double sum = 0;
    for (const Ring& face : faces) sum += factor(point, normal, face);
    EXPECT_NEAR(sum, 1, 1e-13);
  }
}

// Means over a receiving rectangle against the closed forms for pairs of rectangles: Gauss and Legendre's
// rule, with y = t^3 towards the common edge, where the factor has a logarithm, and
// x = u^2 (3 - 2u) towards its ends.
TEST(PolygonFactor, HasTheMeansOfTheClosedFormsForPairsOfRectangles) {
  constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363};
  constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                             0.1012285362903763};
  const auto mean = [&](auto&& f, double width, double depth) {
    constexpr int kParts = 16;
    double sum = 0;
    for (int cell = 0; cell < kParts * kParts; ++cell) {
      for (int k = 0; k < 64; ++k) {
        const auto i = static_cast<std::size_t>(k % 8), j = static_cast<std::size_t>(k / 8);
        const double u = (cell % kParts + (1 + (i < 4 ? -kNode[i] : kNode[i - 4])) / 2) / kParts;
        const double t = (cell / kParts + (1 + (j < 4 ? -kNode[j] : kNode[j - 4])) / 2) / kParts;
        sum += kWeight[i % 4] * kWeight[j % 4] / 4 / (kParts * kParts) * 3 * t * t * 6 * u * (1 - u) *
               f(width * u * u * (3 - 2 * u), depth * t * t * t);
      }
    }
    return sum;
  };
  const auto opposite = [](double x, double y) { return factor({x, y, 0}, kUp, ceiling(0, 1, 0, 1, 1)); };
  EXPECT_NEAR(mean(opposite, 1, 1), 0.199824895698, 1e-10);
  const auto wall = [](double width, double height) {
    return [=](double x, double y) {
      return factor({x, y, 0}, kUp, {{0, 0, 0}, {0, 0, height}, {width, 0, height}, {width, 0, 0}});
    };
  };
  EXPECT_NEAR(mean(wall(1, 1), 1, 1), 0.200043776075, 1e-8);
  EXPECT_NEAR(mean(wall(0.7, 0.3), 0.7, 0.5), 0.175145070955, 1e-8);
}

// Against the exact factor, for rectangles, triangles and hexagons in any position: within 0.3 % of it
// wherever the quick sum stands in for it.
TEST(FactorPolygon, QuickIsNearlyExact) {
  Dice dice(31);
  std::vector<glm::dvec3> scratch;
  double worst = 0;
  int far = 0;
  for (int k = 0; k < 4000; ++k) {
    const glm::dmat3 turn = dice.rotation();
    const double wide = dice.between(0.2, 1), high = dice.between(0.2, 1);
    Ring ring;
    if (k % 3 == 0) {
      ring = {{0, 0, 0}, {wide, 0, 0}, {wide, high, 0}, {0, high, 0}};
    } else if (k % 3 == 1) {
      ring = {{0, 0, 0}, {wide, 0, 0}, {dice.between(0, 1), high, 0}};
    } else {
      for (int c = 0; c < 6; ++c)
        ring.push_back(
            {wide * std::cos(c * std::numbers::pi / 3), high * std::sin(c * std::numbers::pi / 3), 0});
    }
    for (glm::dvec3& corner : ring) corner = turn * corner;
    const FactorPolygon polygon(ring);
    const glm::dvec3 point =
        polygon.centre() + dice.between(1, 10) * polygon.radius() * (dice.rotation() * kUp);
    const glm::dvec3 normal = dice.rotation() * kUp;
    const double exact = polygon.exact(point, normal, scratch);
    if (exact <= 0) continue;
    const double quick = polygon.quick(point, normal, scratch);
    far += quick != exact;
    worst = std::max(worst, std::abs(quick / exact - 1));
  }
  EXPECT_GT(far, 300);
  EXPECT_LT(worst, 3e-3);
}

}  // namespace
}  // namespace unshot
