#include "rays/scene_rays.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "mesh/build.h"
#include "mesh/mesh_rays.h"
#include "scene/scene_triangles.h"
#include "support/dice.h"
#include "support/random_scene.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

SceneRays raysOf(const Scene& scene) { return {scene.positions, trianglesOf(scene).corners}; }

double areaOf(const Scene& scene) {
  const SceneRays rays = raysOf(scene);
  double area = 0;
  for (std::uint32_t t = 0; t < rays.triangleCount(); ++t) area += rays.triangle(t).area;
  return area;
}

TEST(SceneTriangles, CoverConcavePolygonsOnce) {
  const Scene scene = lShapedRoom();
  EXPECT_NEAR(areaOf(scene), 3 + 3 + 8, 1e-12);
  EXPECT_EQ(trianglesOf(scene).size(), 2 * 4 + 6 * 2);
}

TEST(SceneRays, SayWhatIsHitAndFromWhichSide) {
  const SceneRays rays({{glm::dvec3(0, 0, 2), {1, 0, 2}, {0, 1, 2}}}, {{0, 1, 2}});
  for (const bool back : {false, true}) {
    const glm::dvec3 origin(0.25, 0.25, back ? 0 : 5), direction(0, 0, back ? 1 : -1);
    const auto hit = rays.intersect(origin, direction);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 0u);
    EXPECT_EQ(hit->back, back);
    EXPECT_NEAR(hit->distance, back ? 2 : 3, 1e-6);
    EXPECT_DOUBLE_EQ(hit->position.z, 2);
    EXPECT_EQ(hit->normal, -direction);
  }
  EXPECT_FALSE(rays.intersect({0.6, 0.6, 5}, {0, 0, -1}));
  EXPECT_TRUE(rays.occluded({0.25, 0.25, 1}, {0.25, 0.25, 3}));
  EXPECT_FALSE(rays.occluded({0.25, 0.25, 1}, {0.25, 0.25, 1.9}));
  EXPECT_FALSE(rays.occluded({0.6, 0.6, 1}, {0.6, 0.6, 3}));
}

TEST(SceneRays, SeeNothingWhereThereIsNothing) {
  const SceneRays rays(std::span<const glm::dvec3>{}, std::span<const std::uint32_t>{});
  EXPECT_FALSE(rays.intersect({0, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(rays.occluded({0, 0, 0}, {0, 0, 1}));
}

// A walk of many bounces neither passes through a wall nor hits the wall it stands on, at any scale.
TEST(SceneRays, StayInAClosedRoomOfAnySize) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Dice dice(7);
    const Scene scene = moved(lShapedRoom(), dice.rotation(), scale);
    const SceneRays rays = raysOf(scene);
    SceneRays::Hit at;
    at.position = rays.triangle(0).point(0.3, 0.3);
    at.normal = rays.triangle(0).normal;
    for (int k = 0; k < 20'000; ++k) {
      // Directions near the surface too.
      glm::dvec3 direction = dice.direction();
      const double up = glm::dot(direction, at.normal);
      if (up < 0) direction -= 2 * up * at.normal;
      if (k % 4 == 0) direction = glm::normalize(direction - 0.9999 * std::abs(up) * at.normal);
      const auto next = rays.intersect(rays.lifted(at.position, at.normal), direction);
      ASSERT_TRUE(next) << scale << ", bounce " << k;
      ASSERT_FALSE(next->back) << scale << ", bounce " << k;
      // Grazing rays along one plane of the L may meet their own plane's continuation at the corner only.
      ASSERT_GT(std::abs(glm::dot(next->normal, at.normal) - 1), 1e-9) << scale << ", bounce " << k;
      at = *next;
    }
  }
}

TEST(MeshRays, NameTheSurfaceAndTheSideThatWasHit) {
  const Scene scene = publishedCornellBox();
  MeshOptions options;
  options.elements = 500;
  const Mesh mesh = buildMesh(scene, options);
  const MeshRays rays(mesh);
  EXPECT_EQ(rays.rays().triangleCount(), mesh.triangles.size());
  Dice dice(3);
  int lit = 0;
  for (int k = 0; k < 2'000; ++k) {
    const auto hit = rays.intersect(dice.inCube(100), dice.direction());
    if (!hit) continue;
    const Surface& surface = mesh.surfaces[hit->surface];
    ASSERT_EQ(rays.surfaceOf(hit->at.triangle), hit->surface);
    ASSERT_NEAR(glm::dot(hit->at.position - surface.origin, surface.normal), 0, 1e-9);
    ASSERT_NEAR(glm::dot(hit->at.normal, surface.normal), hit->at.back ? -1 : 1, 1e-9);
    if (hit->side == kNone) continue;
    ++lit;
    ASSERT_EQ(mesh.sides[hit->side].surface, hit->surface);
    ASSERT_EQ(mesh.sides[hit->side].back, hit->at.back);
  }
  EXPECT_GT(lit, 1'000);
}

TEST(SceneRays, DrawPointsUniformlyFromTriangles) {
  const SceneRays rays({{glm::dvec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}}}, {{0, 1, 2}});
  Dice dice(1);
  glm::dvec3 mean(0.0);
  for (int k = 0; k < 10'000; ++k) mean += rays.triangle(0).point(dice.uniform(), dice.uniform()) / 1e4;
  EXPECT_NEAR(mean.x, 1.0 / 3, 0.01);
  EXPECT_NEAR(mean.y, 1.0 / 3, 0.01);
  EXPECT_DOUBLE_EQ(rays.triangle(0).area, 0.5);
}

TEST(SceneRays, TogetherFindWhatEachFindsAlone) {
  const Scene scene = publishedCornellBox();
  const SceneRays rays = raysOf(scene);
  Dice dice(5);
  const double size = glm::length(scene.bounds_max - scene.bounds_min);
  const glm::dvec3 middle = (scene.bounds_min + scene.bounds_max) / 2.0;
  std::size_t met = 0, all = 0;
  for (int k = 0; k < 500; ++k) {
    const glm::dvec3 from = middle + dice.inCube(0.3 * size);
    std::vector<glm::dvec3> to;
    for (std::size_t n = static_cast<std::size_t>(k) % (SceneRays::kTogether + 1); to.size() < n;)
      to.push_back(middle + dice.inCube(0.3 * size));
    const std::uint32_t found = rays.occluded(from, to);
    for (std::size_t n = 0; n < to.size(); ++n) {
      EXPECT_EQ(found >> n & 1, rays.occluded(from, to[n]) ? 1u : 0u);
      met += found >> n & 1;
      ++all;
    }
    EXPECT_EQ(std::uint64_t{found} >> to.size(), 0u);
  }
  EXPECT_GT(met, all / 10);
  EXPECT_LT(met, all * 9 / 10);
}

// Walls that have the whole scene on one side are not among what is asked for, and make no difference:
// between points of lit sides that face each other.
TEST(MeshRays, FindsTheSameOccludedWithoutWhatCanNotOcclude) {
  std::size_t met = 0, segments = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    MeshOptions options;
    options.elements = 50;
    const Mesh mesh = buildMesh(RandomScene(seed).scene(), options);
    if (mesh.sides.empty()) continue;
    const MeshRays rays(mesh);
    Dice dice(seed);
    const auto placeOn = [&](const Side& side) {
      const Range& triangles = mesh.surfaces[side.surface].triangles;
      const SceneRays::Triangle& triangle =
          rays.rays().triangle(triangles.first + dice.below(triangles.count));
      return rays.rays().lifted(triangle.point(dice.uniform(), dice.uniform()), side.normal);
    };
    const auto anySide = [&] {
      return mesh.sides[dice.below(static_cast<std::uint32_t>(mesh.sides.size()))];
    };
    for (int k = 0; k < 200; ++k) {
      const Side from = anySide();
      const glm::dvec3 a = placeOn(from);
      std::vector<glm::dvec3> ends;
      for (int tries = 0; tries < 40 && ends.size() < SceneRays::kTogether; ++tries) {
        const Side to = anySide();
        const glm::dvec3 b = placeOn(to);
        if (glm::dot(b - a, from.normal) > 0 && glm::dot(a - b, to.normal) > 0) ends.push_back(b);
      }
      if (ends.empty()) continue;
      const std::uint32_t all = rays.rays().occluded(a, ends);
      EXPECT_EQ(rays.occluded(a, ends), all) << "scene " << seed;
      segments += ends.size();
      met += static_cast<std::size_t>(std::popcount(all));
    }
  }
  EXPECT_GT(met, segments / 10);
  EXPECT_LT(met, segments);
}

}  // namespace
}  // namespace unshot
