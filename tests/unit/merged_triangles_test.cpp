// Blocks of cells that coarse pictures draw as one: they cover what the mesh covers, from the same side.
#include "render/merged_triangles.h"

#include <gtest/gtest.h>

#include <atomic>
#include <glm/geometric.hpp>
#include <numeric>

#include "mesh/build.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Vertices between which light is continuous: those that triangles join.
std::vector<std::uint32_t> continents(const Mesh& mesh) {
  std::vector<std::uint32_t> of(mesh.vertices.size());
  std::iota(of.begin(), of.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (of[v] != v) v = of[v] = of[of[v]];
    return v;
  };
  const std::vector<std::uint32_t>& corner = mesh.triangle_vertices;
  for (std::size_t k = 0; k < corner.size(); ++k) of[find(corner[k])] = find(corner[k - k % 3]);
  for (std::uint32_t v = 0; v < of.size(); ++v) of[v] = find(v);
  return of;
}

// [m^2], along normals, by continent.
std::vector<glm::dvec3> vectorAreas(const Mesh& mesh, const std::vector<std::uint32_t>& corners) {
  const std::vector<std::uint32_t> continent = continents(mesh);
  std::vector<glm::dvec3> out(mesh.vertices.size(), glm::dvec3(0.0));
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const auto at = [&](std::size_t i) { return glm::dvec3(mesh.vertices[corners[k + i]].position); };
    EXPECT_EQ(continent[corners[k]], continent[corners[k + 1]]);
    EXPECT_EQ(continent[corners[k]], continent[corners[k + 2]]);
    out[continent[corners[k]]] += glm::cross(at(1) - at(0), at(2) - at(0)) / 2.0;
  }
  return out;
}

Scene square() {
  SceneBuilder b;
  b.material("white", glm::dvec3(0.5), glm::dvec3(1.0));
  b.quad(0, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  return b.finish();
}

TEST(MergedTriangles, CoverWhatTheMeshCoversFromTheSameSide) {
  // Blocks stand on the floor of the box, under which light does not go on; some walls are lit on either
  // side.
  for (const Scene& scene : {publishedCornellBox(), blockOnFloor(0.3), square()}) {
    const Mesh mesh = buildMesh(scene, {20'000, {}, false});
    const std::size_t triangles = mesh.triangle_vertices.size() / 3;
    const MergedTriangles merged = mergeTriangles(mesh, triangles / 2);
    ASSERT_TRUE(merged.corners);
    EXPECT_EQ(merged.cut, mesh.cut);
    EXPECT_LT(merged.corners->size() / 3, triangles / 2);
    ASSERT_EQ(merged.elements->size(), merged.corners->size() / 3);
    for (std::size_t t = 0; t < merged.elements->size(); ++t) {
      const Surface& surface = mesh.surfaces[mesh.sides[mesh.element_side[(*merged.elements)[t]]].surface];
      const glm::dvec3 corner(mesh.vertices[(*merged.corners)[3 * t]].position);
      EXPECT_LE(std::abs(glm::dot(corner - surface.origin, surface.normal)),
                1e-6 * glm::length(mesh.bounds_max - mesh.bounds_min))
          << "an element of another surface";
    }
    const auto all = vectorAreas(mesh, mesh.triangle_vertices), few = vectorAreas(mesh, *merged.corners);
    // Positions are in single precision.
    for (std::size_t c = 0; c < all.size(); ++c)
      EXPECT_LE(glm::distance(few[c], all[c]), 1e-5 * glm::length(all[c]));
  }
}

TEST(MergedTriangles, AreAsFewAsAskedWhereCellsAllow) {
  const Mesh mesh = buildMesh(square(), {10'000, {}, false});
  const std::size_t triangles = mesh.triangle_vertices.size() / 3;
  EXPECT_FALSE(mergeTriangles(mesh, triangles).corners) << "they are few enough as they are";
  std::size_t before = triangles;
  for (const double share : {0.9, 0.2, 0.05}) {  // 2 x 2, 4 x 4, 8 x 8 cells
    const auto most = static_cast<std::size_t>(share * static_cast<double>(triangles));
    const MergedTriangles merged = mergeTriangles(mesh, most);
    ASSERT_TRUE(merged.corners);
    const std::size_t count = merged.corners->size() / 3;
    EXPECT_LE(count, most);
    EXPECT_NEAR(static_cast<double>(before) / static_cast<double>(count), 4, 0.5);
    before = count;
  }
}

TEST(MergedTriangles, GiveUpWhenAsked) {
  const Mesh mesh = buildMesh(square(), {10'000, {}, false});
  const std::atomic<bool> given_up{true};
  EXPECT_THROW(mergeTriangles(mesh, 10, CancelToken(given_up)), Cancelled);
}

}  // namespace
}  // namespace unshot
