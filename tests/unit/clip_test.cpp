#include "mesh/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "support/dice.h"

namespace unshot {
namespace {

using testing_support::Dice;

// A convex polygon: corners of an ellipse at increasing angles, all edges outline.
ConvexPolygon somePolygon(Dice& dice) {
  ConvexPolygon out;
  const int corners = 3 + static_cast<int>(dice.below(5));
  const double a = dice.between(0.2, 2), b = dice.between(0.2, 2), start = dice.between(0, 6);
  for (int k = 0; k < corners; ++k) {
    const double t = start + (k + dice.between(0, 0.8)) * 2 * std::acos(-1.0) / corners;
    out.push_back({{a * std::cos(t), b * std::sin(t)}, true});
  }
  return out;
}

TEST(Clip, CutsAPolygonIntoTwoThatAddUp) {
  Dice dice(1);
  for (int k = 0; k < 500; ++k) {
    const ConvexPolygon whole = somePolygon(dice);
    const int axis = k % 2;
    const double at = dice.between(-2, 2);
    ConvexPolygon low, high;
    clipAt(whole, axis, at, -1, low);
    clipAt(whole, axis, at, 1, high);
    const double below = low.empty() ? 0 : polygonArea(low), above = high.empty() ? 0 : polygonArea(high);
    EXPECT_GE(below, 0);
    EXPECT_GE(above, 0);
    EXPECT_NEAR(below + above, polygonArea(whole), 1e-14);
    for (const PieceCorner& c : low) EXPECT_LE(c.uv[axis], at);
    for (const PieceCorner& c : high) EXPECT_GE(c.uv[axis], at);
  }
}

TEST(Clip, MarksOnlyWhatWasOutlineAsOutline) {
  Dice dice(2);
  for (int k = 0; k < 200; ++k) {
    const ConvexPolygon whole = somePolygon(dice);
    const double at = dice.between(-0.1, 0.1);
    ConvexPolygon half;
    clipAt(whole, 0, at, 1, half);
    for (std::size_t c = 0; c < half.size(); ++c) {
      const bool on_cut = half[c].uv.x == at && half[(c + 1) % half.size()].uv.x == at;
      EXPECT_EQ(half[c].outline, !on_cut);
    }
  }
}

TEST(Clip, GivesNeighboursTheSamePointToTheLastBit) {
  Dice dice(3);
  for (int k = 0; k < 500; ++k) {
    const glm::dvec2 p{dice.between(-1, 0), dice.between(-1, 1)}, q{dice.between(0, 1), dice.between(-1, 1)};
    const double at = dice.between(-0.01, 0.01);
    ConvexPolygon one, other;
    clipAt({{p, false}, {q, false}, {{0, 5}, false}}, 0, at, 1, one);
    clipAt({{q, false}, {p, false}, {{0, -5}, false}}, 0, at, 1, other);
    bool found = false;
    for (const PieceCorner& a : one) {
      for (const PieceCorner& b : other) found = found || (a.uv == b.uv && a.uv.x == at);
    }
    EXPECT_TRUE(found || p.x > at || q.x < at);
  }
}

TEST(Clip, HasAreaAndCentroidOfARectangle) {
  const ConvexPolygon r{{{1, 2}, false}, {{4, 2}, false}, {{4, 7}, false}, {{1, 7}, false}};
  EXPECT_NEAR(polygonArea(r), 15, 1e-14);
  EXPECT_LT(glm::distance(polygonCentroid(r), glm::dvec2(2.5, 4.5)), 1e-14);
  EXPECT_TRUE(contains(r, {1, 2}));
  EXPECT_TRUE(contains(r, {3, 3}));
  EXPECT_FALSE(contains(r, {0.999, 3}));
  EXPECT_NEAR(distanceOutside(r, {3, 3}), -1, 1e-14);
  EXPECT_NEAR(distanceOutside(r, {1, 4}), 0, 1e-14);
  EXPECT_NEAR(distanceOutside(r, {0.5, 3}), 0.5, 1e-14);
  EXPECT_NEAR(distanceOutside(r, {3, 9}), 2, 1e-14);
}

TEST(Clip, HasTheCentroidThatItsHalvesHave) {
  Dice dice(4);
  for (int k = 0; k < 200; ++k) {
    const ConvexPolygon whole = somePolygon(dice);
    ConvexPolygon low, high;
    clipAt(whole, 1, 0.05, -1, low);
    clipAt(whole, 1, 0.05, 1, high);
    if (low.empty() || high.empty()) continue;
    const glm::dvec2 moment =
        polygonArea(low) * polygonCentroid(low) + polygonArea(high) * polygonCentroid(high);
    EXPECT_LT(glm::distance(moment / polygonArea(whole), polygonCentroid(whole)), 1e-12);
    EXPECT_TRUE(contains(whole, polygonCentroid(whole)));
  }
}

}  // namespace
}  // namespace unshot
