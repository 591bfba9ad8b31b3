// Patches that several small surfaces make, and what is seen of them.
#include "mesh/patch_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>
#include <vector>

#include "formfactor/patch_polygons.h"
#include "formfactor/receivers.h"
#include "formfactor/regions.h"
#include "mesh/build.h"
#include "support/dice.h"
#include "support/many_rooms.h"
#include "support/solving.h"

namespace unshot {
namespace {

using namespace testing_support;

Mesh roomWithBall() { return buildMesh(manyRooms(1, 24, 24), {3000, {}, false}); }

const Side& sideOf(const Mesh& mesh, std::uint32_t part) { return mesh.sides[mesh.patch_parts[part].side]; }

TEST(PatchParts, OfABallAreJoinedIntoPatchesThatFaceOneWay) {
  const Mesh mesh = roomWithBall();
  std::vector<int> seen(mesh.patch_parts.size(), 0);
  std::uint32_t joined = 0;
  double area = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const auto parts = mesh.partsOf(q);
    ASSERT_FALSE(parts.empty());
    EXPECT_EQ(mesh.patch_side[q], mesh.patch_parts[parts[0]].side);
    area += mesh.patch_area[q];
    joined += mesh.joined(q);
    for (const std::uint32_t part : parts) {
      ++seen[part];
      EXPECT_EQ(mesh.patch_parts[part].patch, q);
      EXPECT_EQ(mesh.surfaces[sideOf(mesh, part).surface].material,
                mesh.surfaces[sideOf(mesh, parts[0]).surface].material);
      // 20 degrees from the part it grew from.
      EXPECT_GT(glm::dot(sideOf(mesh, part).normal, sideOf(mesh, parts[0]).normal), std::cos(0.7));
    }
    if (!mesh.joined(q)) continue;
    EXPECT_LE(mesh.patch_area[q], mesh.patch_size * mesh.patch_size);
    EXPECT_FALSE(mesh.emits(q));
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_NEAR(area, mesh.lit_area, 1e-9 * area);
  EXPECT_GT(joined, 50u);
  EXPECT_LT(mesh.patch_count, mesh.patch_parts.size() / 3);
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const std::uint32_t local =
        mesh.shapes[mesh.surfaces[side.surface].elements.first + e - side.first_element].patch;
    EXPECT_EQ(mesh.patch_parts[side.first_part + local].patch, mesh.element_patch[e]);
  }
}

// A floor of strips that bends a little on the line where a wall stands, which has corners with it or goes
// through it: patches end there.
TEST(PatchParts, EndAtAWallOnACrease) {
  for (const bool shared : {true, false}) {
    SceneBuilder b;
    const auto grey = b.material("grey", glm::dvec3(0.7)), lamp = b.material("lamp", {}, glm::dvec3(10));
    constexpr int kStrips = 64;
    constexpr double kDepth = 0.5;
    const auto height = [](double x) { return 0.05 * x * (4 - x); };
    for (int k = 0; k < kStrips; ++k) {
      const double x0 = 4.0 * k / kStrips, x1 = 4.0 * (k + 1) / kStrips;
      b.polygon(
          grey,
          {{x0, height(x0), 0}, {x0, height(x0), kDepth}, {x1, height(x1), kDepth}, {x1, height(x1), 0}});
    }
    const double foot = shared ? height(2) : height(2) - 0.1;
    b.polygon(grey, {{2, foot, 0}, {2, foot, kDepth}, {2, 2, kDepth}, {2, 2, 0}});
    b.quad(grey, {0, 2, 0}, {4, 0, 0}, {0, 0, kDepth});
    for (const double z : {0.0, kDepth}) b.quad(grey, {0, -0.2, z}, {4, 0, 0}, {0, 2.2, 0});
    for (const double x : {0.0, 4.0}) b.quad(grey, {x, -0.2, 0}, {0, 0, kDepth}, {0, 2.2, 0});
    b.quad(lamp, {0.5, 1.9, 0.1}, {1, 0, 0}, {0, 0, 0.3});
    MeshOptions options{60, {}, false};
    options.dark_sides = true;
    const Scene scene = b.finish();
    const Mesh mesh = buildMesh(scene, options);
    bool joined = false;
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
      int left = 0, right = 0;
      for (const std::uint32_t part : mesh.partsOf(q)) {
        const Surface& surface = mesh.surfaces[sideOf(mesh, part).surface];
        (mesh.shapes[surface.elements.first].centre.x < 2 ? left : right) += 1;
      }
      joined = joined || left > 1 || right > 1;
      EXPECT_FALSE(left > 0 && right > 0) << "patch " << q << (shared ? ", shared" : "");
    }
    EXPECT_TRUE(joined);
  }
}

// Against the sum of exact factors of what of each part faces the point, without occlusion: within 1 % of
// the largest there is (0.3 % of a part by the rule, and what straddles the horizon).
TEST(PatchParts, LookAsTheyDoOneByOne) {
  const Mesh mesh = roomWithBall();
  const PatchPolygons polygons(mesh);
  Dice dice(5);
  std::vector<glm::dvec3> scratch;
  double squares = 0, exact_squares = 0, worst = 0;
  for (int k = 0; k < 20'000; ++k) {
    const std::uint32_t q = dice.below(mesh.patch_count);
    if (!mesh.joined(q)) continue;
    const glm::dvec3 point{dice.between(0, 4), dice.between(0, 3), dice.between(0, 4)};
    const glm::dvec3 normal = glm::normalize(
        glm::dvec3{dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)} + glm::dvec3(1e-6));
    double exact = 0;
    for (const FactorPolygon& part : polygons.parts(q)) {
      if (glm::dot(part.normal(), point - part.centre()) > 0)
        exact += std::max(part.exact(point, normal, scratch), 0.0);
    }
    EXPECT_NEAR(polygons.factor(q, point, normal, scratch), exact, 1e-9 + 1e-6 * exact);
    const double quick = polygons.quickFactor(q, point, normal, scratch);
    squares += (quick - exact) * (quick - exact);
    exact_squares += exact * exact;
    worst = std::max(worst, std::abs(quick - exact) / std::max(exact, 1e-3));
  }
  EXPECT_GT(exact_squares, 0);
  EXPECT_LT(std::sqrt(squares / exact_squares), 0.01);
  EXPECT_LT(worst, 0.1);
}

TEST(PatchParts, MakeOneViewOfAVertexOfTheirs) {
  const Mesh mesh = roomWithBall();
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  std::size_t several = 0;
  for (std::uint32_t v = 0; v < receivers.size(); ++v) {
    double weight = 0;
    std::set<std::uint32_t> patches;
    for (const ReceiverView& view : receivers.viewsOf(v)) {
      weight += view.weight;
      EXPECT_NEAR(glm::length(view.normal), 1, 1e-12);
      if (mesh.joined(view.patch)) {
        EXPECT_TRUE(patches.insert(view.patch).second);
        several += sideOf(mesh, mesh.partsOf(view.patch)[0]).normal != view.normal;
      }
    }
    EXPECT_NEAR(weight, 1, 1e-9);
  }
  EXPECT_GT(several, 100u);
}

TEST(PatchParts, AreShotInHalvesThatAddUp) {
  const Mesh mesh = roomWithBall();
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    if (!mesh.joined(q)) continue;
    std::vector<Region> regions{regionOfPatch(mesh, q)};
    EXPECT_NEAR(regions[0].area, mesh.patch_area[q], 1e-9 * mesh.patch_area[q]);
    for (int depth = 0; depth < 6; ++depth) {
      std::vector<Region> finer;
      double area = 0;
      for (const Region& region : regions) {
        for (Region& part : partsOf(mesh, region)) {
          area += part.area;
          EXPECT_EQ(mesh.sides[part.side].surface, part.surface);
          finer.push_back(std::move(part));
        }
      }
      EXPECT_NEAR(area, mesh.patch_area[q], 1e-9 * area);
      regions = std::move(finer);
    }
  }
}

// Base and refined mesh have the same patches.
TEST(PatchParts, StayWhereAMeshIsRefined) {
  SolveOptions options;
  options.error = 0.05;
  options.soonest = true;
  options.form_factors = "rays";
  const auto solve = begun(manyRooms(1, 16, 16), options);
  const Mesh& mesh = solve->mesh();
  ASSERT_TRUE(mesh.base);
  ASSERT_EQ(mesh.patch_count, mesh.base->patch_count);
  std::uint32_t joined = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const auto parts = mesh.partsOf(q), of_base = mesh.base->partsOf(q);
    ASSERT_TRUE(std::equal(parts.begin(), parts.end(), of_base.begin(), of_base.end()));
    joined += mesh.joined(q);
  }
  EXPECT_GT(joined, 20u);
}

}  // namespace
}  // namespace unshot
