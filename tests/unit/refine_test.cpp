// Refined meshes: as sound as uniform ones, with the same patches, and fields of the base's vertices carried
// over exactly where they are as smooth as the interpolation says.
#include "mesh/refine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>

#include "formfactor/receivers.h"
#include "mesh/build.h"
#include "mesh/patch_lattice.h"
#include "scene/analytic_scenes.h"
#include "scene/obj_reader.h"
#include "support/dice.h"
#include "support/mesh_checks.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

std::shared_ptr<const Mesh> baseOf(const Scene& scene, std::uint64_t elements) {
  return std::make_shared<const Mesh>(buildMesh(scene, {elements, {}, false, true}));
}

// Quarters half of the parts at random, down to three times.
Mesh refinedAtRandom(std::shared_ptr<const Mesh> base, std::uint64_t seed) {
  Dice dice(seed);
  return refineMesh(std::move(base),
                    [&](const CellPart& part) { return part.depth < 3 && dice.between(0, 1) < 0.5; });
}

std::vector<Scene> scenes() {
  return {furnaceScene(0.5, 0.5), blockOnFloor(0.3), publishedCornellBox(),
          concentricSpheres(0.5, 1, 0.5, 0, 8), lShapedRoom()};
}

TEST(RefinedMesh, IsSoundAndKeepsSidesAndPatches) {
  std::uint64_t seed = 0;
  for (const Scene& scene : scenes()) {
    const auto base = baseOf(scene, 400);
    const Mesh mesh = refinedAtRandom(base, ++seed);
    EXPECT_GT(mesh.element_count, 2 * base->element_count);
    expectSoundMesh(mesh);
    expectNoVertexWithinAnEdge(mesh, 2 * mesh.weld_distance);
    ASSERT_EQ(mesh.patch_count, base->patch_count);
    EXPECT_EQ(mesh.patch_side, base->patch_side);
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q)
      EXPECT_NEAR(mesh.patch_area[q], base->patch_area[q], 1e-9 * base->patch_area[q]);
    ASSERT_EQ(mesh.element_from_base.size(), mesh.element_count);
    std::vector<double> area(base->element_count, 0.0);
    for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
      const std::uint32_t old = mesh.element_from_base[e];
      EXPECT_EQ(mesh.element_patch[e], base->element_patch[old]);
      EXPECT_EQ(mesh.element_side[e], base->element_side[old]);
      area[old] += mesh.element_area[e];
    }
    for (std::uint32_t e = 0; e < base->element_count; ++e)
      EXPECT_NEAR(area[e], base->element_area[e], 1e-9 * base->element_area[e]);
  }
}

// Contacts that nearly coincide leave slivers of cells far below rounding of their area, with patches of
// their own.
TEST(RefinedMesh, LosesNoSliver) {
  const char* scenes = std::getenv("UNSHOT_SCENES");
  if (!scenes) GTEST_SKIP() << "UNSHOT_SCENES is not set";
  const auto base = baseOf(readObj(std::filesystem::path(scenes) / "holodeck" / "holodeck.obj"), 2500);
  const Mesh mesh = refineMesh(base, [](const CellPart& part) { return part.depth < 1; });
  double least = INFINITY;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    least = std::min(least, base->patch_area[q]);
    EXPECT_NEAR(mesh.patch_area[q] / base->patch_area[q], 1, 1e-3);
  }
  EXPECT_LT(least, 1e-9);
}

TEST(RefinedMesh, IsAskedForWhereAnyCellIsToBeQuartered) {
  const auto base = baseOf(publishedCornellBox(), 400);
  std::size_t cells = 0;
  EXPECT_FALSE(asksForAny(*base, [&](const CellPart& part) {
    EXPECT_EQ(part.depth, 0u);
    EXPECT_FALSE(part.pieces.empty());
    ++cells;
    return false;
  }));
  std::size_t asked = 0;
  refineMesh(base, [&](const CellPart&) { return ++asked == 0; });
  EXPECT_EQ(cells, asked);
  std::size_t until = 0;
  EXPECT_TRUE(asksForAny(*base, [&](const CellPart&) { return ++until == cells; }));
}

TEST(RefinedMesh, IsTheBaseWhereNothingIsQuartered) {
  const auto base = baseOf(publishedCornellBox(), 400);
  const Mesh mesh = refineMesh(base, [](const CellPart&) { return false; });
  EXPECT_EQ(mesh.element_count, base->element_count);
  // Elements are numbered as their first piece comes along.
  for (std::uint32_t e = 0; e < mesh.element_count; ++e)
    EXPECT_NEAR(mesh.element_area[e], base->element_area[mesh.element_from_base[e]],
                1e-9 * mesh.element_area[e]);
  EXPECT_EQ(mesh.triangle_vertices, base->triangle_vertices);
  ASSERT_EQ(mesh.triangle_element.size(), base->triangle_element.size());
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t)
    EXPECT_EQ(mesh.element_from_base[mesh.triangle_element[t]], base->triangle_element[t]);
}

// A linear field passes through lines, triangles and parabolas alike; vertices are in single precision, and
// the scenes measure up to 6 m.
TEST(RefinedMesh, InterpolatesALinearFieldOfTheBaseExactly) {
  const auto field = [](const glm::vec3& p) { return glm::dot(glm::dvec3(p), glm::dvec3(1, -2, 3)); };
  std::uint64_t seed = 20;
  for (const Scene& scene : {furnaceScene(0.5, 0.5), blockOnFloor(0.3), lShapedRoom()}) {
    const auto base = baseOf(scene, 400);
    const Mesh mesh = refinedAtRandom(base, ++seed);
    const SparseRows& rows = mesh.vertex_from_base;
    ASSERT_EQ(rows.size(), mesh.vertices.size());
    for (std::size_t v = 0; v < rows.size(); ++v) {
      double sum = 0, weights = 0;
      for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) {
        sum += static_cast<double>(rows.weight[k]) * field(base->vertices[rows.index[k]].position);
        weights += static_cast<double>(rows.weight[k]);
      }
      EXPECT_NEAR(weights, 1, 1e-6);
      EXPECT_NEAR(sum, field(mesh.vertices[v].position), 2e-3)
          << "vertex " << v;  // weights below 1e-4 are cut off
    }
  }
}

// Over patches of two by two whole cells a quadratic field and its mean are exact.
TEST(PatchLattice, IsExactForAQuadraticField) {
  const auto base = baseOf(furnaceScene(0.5, 0.5), 900);
  const auto lattices = patchLattices(*base);
  const auto field = [](const glm::dvec2& p) {
    return 1 + 2 * p.x - p.y + 3 * p.x * p.x + p.x * p.y - 2 * p.y * p.y;
  };
  std::size_t nines = 0;
  for (std::uint32_t q = 0; q < base->patch_count; ++q) {
    ASSERT_TRUE(lattices[q].has_value()) << "patch " << q;
    const PatchLattice& lattice = *lattices[q];
    if (lattice.size() != 9) continue;
    ++nines;
    const Surface& surface = base->surfaces[base->sides[base->patch_side[q]].surface];
    double mean = 0;
    const auto weights = lattice.meanWeights();
    std::array<double, 9> at{};
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      EXPECT_GT(weights[k], 0);
      at[k] = field(surface.chart(glm::dvec3(base->vertices[lattice.vertex[k]].position)));
      mean += weights[k] * at[k];
    }
    // Gauss's rule of two by two points is exact for it too.
    double exact = 0;
    const glm::dvec2 middle = (lattice.low + lattice.high) / 2.0, half = (lattice.high - lattice.low) / 2.0;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0})
        exact += field(middle + half * glm::dvec2(x, y) / std::sqrt(3.0)) / 4;
    }
    EXPECT_NEAR(mean, exact, 1e-6);
    const glm::dvec2 somewhere = glm::mix(lattice.low, lattice.high, glm::dvec2(0.3, 0.8));
    double value = 0;
    const auto there = lattice.weightsAt(somewhere);
    for (std::size_t k = 0; k < lattice.size(); ++k) value += there[k] * at[k];
    EXPECT_NEAR(value, field(somewhere), 1e-6);
  }
  EXPECT_EQ(nines, base->patch_count);
}

// Both layers of receivers divide the lit area and each patch among them.
TEST(LayeredReceivers, DivideEachPatchInBothLayers) {
  const Mesh mesh = refinedAtRandom(baseOf(publishedCornellBox(), 400), 5);
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  ASSERT_TRUE(receivers.layered());
  ASSERT_EQ(receivers.shownCount(), mesh.vertices.size());
  ASSERT_EQ(receivers.size(), mesh.vertices.size() + mesh.base->vertices.size());
  for (const bool emitter : {true, false}) {
    const Range layer = receivers.reachedBy(emitter);
    std::vector<double> of_patch(mesh.patch_count, 0.0);
    double area = 0;
    for (std::uint32_t v = layer.first; v < layer.end(); ++v) {
      area += receivers.area[v];
      EXPECT_FALSE(receivers.viewsOf(v).empty());
      for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
        EXPECT_EQ(receivers.shares[s].receiver, v);
        of_patch[receivers.shares[s].patch] += receivers.shares[s].area;
      }
    }
    EXPECT_NEAR(area, mesh.lit_area, 1e-6 * mesh.lit_area);
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q)
      EXPECT_NEAR(of_patch[q], mesh.patch_area[q], 1e-4 * mesh.patch_area[q]) << "patch " << q;
  }
}

TEST(LayeredReceivers, ShowNothingBeyondTheValuesAround) {
  const Mesh mesh = refinedAtRandom(baseOf(publishedCornellBox(), 400), 6);
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  Dice dice(7);
  std::vector<glm::dvec3> field(receivers.size(), glm::dvec3(0.0));
  for (std::uint32_t v = receivers.base_first; v < receivers.size(); ++v)
    field[v] = glm::dvec3(dice.between(0, 1) < 0.5 ? 0.0 : 1.0);
  for (std::uint32_t v = 0; v < receivers.shownCount(); ++v) {
    EXPECT_GE(receivers.shown(v, field).x, 0);
    EXPECT_LE(receivers.shown(v, field).x, 1);
  }
}

}  // namespace
}  // namespace unshot
