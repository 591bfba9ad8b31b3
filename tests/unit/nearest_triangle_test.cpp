#include "rays/nearest_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace unshot {
namespace {

const auto kAll = [](std::uint32_t) { return true; };

TEST(NearestTriangle, FindsInteriorEdgeAndCorner) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::uint32_t> corners = {0, 1, 2};
  const NearestTriangle nearest(positions, corners);
  const auto inside = nearest.find({0.25f, 0.25f, 0.1f}, 1, kAll);
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->distance, 0.1f, 1e-6f);
  EXPECT_NEAR(inside->weights.y, 0.25f, 1e-6f);
  EXPECT_NEAR(inside->weights.z, 0.25f, 1e-6f);
  const auto edge = nearest.find({0.5f, -0.2f, 0}, 1, kAll);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->distance, 0.2f, 1e-6f);
  EXPECT_EQ(edge->weights.z, 0);
  const auto corner = nearest.find({2, -1, 0}, 5, kAll);
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->weights, glm::vec3(0, 1, 0));
  EXPECT_FALSE(nearest.find({0, 0, 1}, 0.9f, kAll));
}

TEST(NearestTriangle, LeavesOutWhatIsNotAccepted) {
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const std::vector<std::uint32_t> corners = {0, 1, 2, 3, 4, 5};
  const NearestTriangle nearest(positions, corners);
  EXPECT_EQ(nearest.find({0.2f, 0.2f, 0.1f}, 5, kAll)->triangle, 0u);
  EXPECT_EQ(nearest.find({0.2f, 0.2f, 0.1f}, 5, [](std::uint32_t t) { return t == 1; })->triangle, 1u);
  EXPECT_FALSE(nearest.find({0.2f, 0.2f, 0.1f}, 5, [](std::uint32_t) { return false; }));
}

TEST(NearestTriangle, NothingIsNearNothing) {
  EXPECT_FALSE(NearestTriangle({}, {}).find({0, 0, 0}, 10, kAll));
}

/// Distance to a triangle by sampling it finely.
float sampledDistance(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  float best = INFINITY;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps;
      best = std::min(best, glm::length(p - ((1 - u - v) * a + u * b + v * c)));
    }
  }
  return best;
}

TEST(NearestTriangle, AgreesWithSamplingOnRandomTriangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto point = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t k = 0; k < 60; ++k) {
    positions.push_back(point());
    corners.push_back(k);
  }
  const NearestTriangle nearest(positions, corners);
  for (int k = 0; k < 50; ++k) {
    const glm::vec3 p = point();
    float expected = INFINITY;
    for (std::size_t t = 0; t < corners.size(); t += 3) {
      expected = std::min(expected, sampledDistance(p, positions[t], positions[t + 1], positions[t + 2]));
    }
    const auto hit = nearest.find(p, 10, kAll);
    ASSERT_TRUE(hit);
    EXPECT_LE(hit->distance, expected + 1e-5f);
    EXPECT_GE(hit->distance, expected - 0.04f);
    EXPECT_NEAR(hit->weights.x + hit->weights.y + hit->weights.z, 1, 1e-5f);
  }
}

}  // namespace
}  // namespace unshot
