// Exact Lambert factors times visibility, by rays and by hemicubes, and the points of patches that both look
// from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <span>

#include "formfactor/patch_polygons.h"
#include "formfactor/polygon_factor.h"
#include "formfactor/shadow_rays.h"
#include "mesh/build.h"
#include "support/solving.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

TEST(PatchPolygons, SpreadsPointsOverDifferentPlacesAlongEachSide) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 0.5), {600, {}, false});
  const PatchPolygons polygons(mesh);
  for (const std::uint32_t n : {1u, 4u, 16u, 64u}) {
    for (std::uint32_t q = 0; q < mesh.patch_count; q += 17) {
      std::vector<glm::dvec3> points;
      polygons.spread(q, n, points);
      ASSERT_EQ(points.size(), n);
      const Surface& surface = mesh.surfaces[mesh.sides[mesh.patch_side[q]].surface];
      const double side = std::sqrt(mesh.patch_area[q]);
      const glm::dvec2 corner = surface.chart(polygons.middle(q)) - side / 2;
      std::set<int> along_u, along_v;
      for (const glm::dvec3& point : points) {
        const glm::dvec2 part = (surface.chart(point) - corner) / side;
        along_u.insert(static_cast<int>(std::floor(part.x * n)));
        along_v.insert(static_cast<int>(std::floor(part.y * n)));
      }
      for (const std::set<int>& places : {along_u, along_v}) {
        EXPECT_EQ(places.size(), n);
        EXPECT_EQ(*places.begin(), 0);
        EXPECT_EQ(*places.rbegin(), static_cast<int>(n) - 1);
      }
    }
  }
}

// Patches that are no rectangles: the points lie on them, and their mean is near the centroid.
TEST(PatchPolygons, SpreadsPointsOverPatchesOfAnyShape) {
  const Mesh mesh = buildMesh(blockOnFloor(0.3), {400, {}, false});
  const PatchPolygons polygons(mesh);
  std::size_t others = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const Surface& surface = mesh.surfaces[mesh.sides[mesh.patch_side[q]].surface];
    std::vector<glm::dvec3> points;
    polygons.spread(q, 64, points);
    const double rectangle = 4 * polygons.radius(q) * polygons.radius(q);
    others += mesh.patch_area[q] < 0.45 * rectangle;
    for (const glm::dvec3& point : points) {
      EXPECT_LE(glm::length(point - polygons.middle(q)), polygons.radius(q) * (1 + 1e-9));
      EXPECT_NEAR(glm::dot(point - surface.origin, surface.normal), 0, 1e-9);
    }
  }
  EXPECT_GT(others, 5u);
}

std::unique_ptr<FormFactorMethod> made(const char* method, const Mesh& mesh) {
  return makeMethod(methodRow(method), mesh);
}

struct PointwiseCase {
  const char* method;
  int places;  // different places along a side of an emitting patch that it is looked at from
};

class PointwiseFactors : public testing::TestWithParam<PointwiseCase> {};

TEST_P(PointwiseFactors, AreTheClosedFormWhereNothingStandsBetween) {
  for (const Scene& scene : {furnaceScene(0.5, 0.5), perpendicularSquares(0.5)}) {
    const Mesh mesh = buildMesh(scene, {200, {}, false});
    const auto method = made(GetParam().method, mesh), exact = made("closed-form", mesh);
    // But for FactorPolygon::quick.
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
      const Column got = method->column(q), wanted = exact->column(q);
      ASSERT_EQ(got.k.size(), wanted.k.size());
      for (std::size_t v = 0; v < got.k.size(); ++v)
        EXPECT_NEAR(got.k[v], wanted.k[v], 3e-3 * static_cast<double>(wanted.k[v])) << q;
    }
  }
}

// What leaves a square of the light that another at a right angle does not get.
TEST_P(PointwiseFactors, FindWhatEscapes) {
  const Mesh mesh = buildMesh(perpendicularSquares(0.5), {800, {}, false});
  const auto method = made(GetParam().method, mesh), exact = made("closed-form", mesh);
  double escaped = 0, expected = 0, area = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    escaped += mesh.patch_area[q] * method->column(q).escape;
    expected += mesh.patch_area[q] * exact->column(q).escape;
    area += mesh.patch_area[q];
  }
  // 144 stratified rays or a hemicube a patch, hundreds of patches.
  EXPECT_NEAR(escaped / area, expected / area, 0.01);
  EXPECT_GT(expected / area, 0.5);
}

// A lamp at y = 2 and, half way, a plate over x > 0: from the floor's x = a the lamp shows where x < -a.
Scene lampAndPlate() {
  SceneBuilder b;
  const auto floor = b.material("floor", glm::dvec3(0.5)), plate = b.material("plate", glm::dvec3(0.0));
  const auto lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(1.0));
  b.quad(floor, {-2, 0, -1}, {0, 0, 2}, {4, 0, 0});
  b.quad(plate, {0, 1, -3}, {4, 0, 0}, {0, 0, 6});
  b.quad(lamp, {-0.5, 2, -0.5}, {1, 0, 0}, {0, 0, 1});
  return b.finish();
}

TEST_P(PointwiseFactors, AreOfThePartOfALampThatAPlateLeaves) {
  const Mesh mesh = buildMesh(lampAndPlate(), {4'000, {}, false});
  const auto method = made(GetParam().method, mesh);
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  std::vector<double> k(receivers.size(), 0.0);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (mesh.sides[mesh.patch_side[q]].emission == glm::dvec3(0.0)) continue;
    method->column(q).forEach([&](std::uint32_t v, double value) { k[v] += value; });
  }
  double worst = 0;
  int dark = 0, lit = 0, penumbra = 0;
  std::vector<glm::dvec3> scratch;
  for (std::uint32_t v = 0; v < receivers.size(); ++v) {
    const ReceiverView& view = receivers.viewsOf(v)[0];
    const glm::dvec3 p = view.position + mesh.frame_origin;
    if (std::abs(p.y) > 1e-6 || view.normal.y < 0.5) continue;
    const auto factorUpTo = [&](double x) {
      if (x <= -0.5) return 0.0;
      const glm::dvec3 ring[] = {{-0.5, 2, -0.5}, {x, 2, -0.5}, {x, 2, 0.5}, {-0.5, 2, 0.5}};
      return pointToPolygonFactor(p, {0, 1, 0}, ring, scratch);
    };
    const double whole = factorUpTo(0.5), exact = factorUpTo(std::min(0.5, -p.x));
    if (p.x > 0.51) {
      EXPECT_EQ(k[v], 0) << p.x;
      ++dark;
    } else if (p.x < -0.51) {
      EXPECT_NEAR(k[v], whole, 1e-6 * whole) << p.x;
      ++lit;
    } else {
      worst = std::max(worst, std::abs(k[v] - exact) / whole);
      ++penumbra;
    }
  }
  EXPECT_GT(dark, 100);
  EXPECT_GT(lit, 100);
  EXPECT_GT(penumbra, 100);
  measured("worst error in the penumbra, of the lamp's whole factor", worst);
  // Half a step from a place to the next, and what the kernel varies over it.
  EXPECT_LT(worst, 1.0 / GetParam().places);
}

// A lamp that is one patch, and a plate's corner turned against its edges: rows of rays and what is found
// between them, against the lamp clipped by the shadow's straight edges.
class ShadowEdges : public testing::TestWithParam<double> {
};  // how long one side of the lamp is, of the other

TEST(ShadowEdges, OfALampAreFoundBetweenRays) {
  for (const double turn : {0.0, 0.5 * std::numbers::pi, 0.3, 1.1}) {
    SceneBuilder b;
    const auto floor = b.material("floor", glm::dvec3(0.5)), plate = b.material("plate", glm::dvec3(0.0));
    const auto lamp = b.material("lamp", glm::dvec3(0.0), glm::dvec3(1.0));
    const glm::dvec3 across(std::cos(turn), 0, std::sin(turn)), along(-std::sin(turn), 0, std::cos(turn));
    b.quad(floor, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
    b.quad(plate, glm::dvec3(0, 1, 0) - 5.0 * along, 6.0 * across, 10.0 * along);
    b.quad(lamp, {-0.5, 2, -0.5}, {1, 0, 0}, {0, 0, 1});
    const Mesh mesh = buildMesh(b.finish(), {1, {}, false, true});
    std::uint32_t q = kNone;
    int emitting = 0;
    for (std::uint32_t p = 0; p < mesh.patch_count; ++p) {
      if (!mesh.emits(p) || mesh.sides[mesh.patch_side[p]].normal.y > 0) continue;
      q = p;
      ++emitting;
    }
    ASSERT_EQ(emitting, 1);
    const auto polygons = std::make_shared<const PatchPolygons>(mesh);
    const auto visibility = makeShadowRays(mesh, polygons, 1);
    std::vector<glm::dvec3> scratch;
    double worst = 0, last = -1, jump = 0;
    // Across the shadow's edge, from all of the lamp to none of it.
    for (double s = -0.9; s <= 0.9; s += 0.01) {
      const glm::dvec3 p = s * across + 0.1 * along;
      // The plate hides what lies beyond its edge as seen from p, at twice the height.
      std::vector<glm::dvec3> ring;
      const glm::dvec3 corners[] = {{-0.5, 2, -0.5}, {0.5, 2, -0.5}, {0.5, 2, 0.5}, {-0.5, 2, 0.5}};
      const auto beyond = [&](const glm::dvec3& c) { return glm::dot(c, across) + s; };
      for (int k = 0; k < 4; ++k) {
        const glm::dvec3 &one = corners[k], &two = corners[(k + 1) % 4];
        const double d = beyond(one), e = beyond(two);
        if (d <= 0) ring.push_back(one);
        if ((d < 0 && e > 0) || (d > 0 && e < 0)) ring.push_back(one + d / (d - e) * (two - one));
      }
      const auto factorOf = [&](std::span<const glm::dvec3> of) {
        return of.size() < 3 ? 0.0 : pointToPolygonFactor(p, {0, 1, 0}, of, scratch);
      };
      const double exact = factorOf(ring) / factorOf(corners);
      std::uint32_t side = 0;
      while (mesh.sides[side].normal.y < 0.5 || mesh.sides[side].reflectance == glm::dvec3(0.0)) ++side;
      const double found = visibility->seen({p - mesh.frame_origin, {0, 1, 0}, 1, side, 0}, q);
      worst = std::max(worst, std::abs(found - exact));
      if (last >= 0) jump = std::max(jump, std::abs(found - last));
      last = found;
    }
    measured("turned by " + std::to_string(turn) + ": worst error of the share", worst);
    measured("largest step in a hundredth of the way", jump);
    // A row's inset, halvings of a quarter of it, and straight pieces of a slanting edge's corner.
    EXPECT_LT(worst, 0.045);
    EXPECT_LT(jump, 0.06);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, PointwiseFactors,
                         testing::Values(PointwiseCase{"rays", 64}, PointwiseCase{"hemicube-visibility", 16}),
                         [](const auto& row) { return testName(row.param.method); });

}  // namespace
}  // namespace unshot
