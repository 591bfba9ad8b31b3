// What light reaches stands apart from what it does not, wherever in the scene either is.
#include "mesh/lit.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mesh/build.h"
#include "mesh/mesh_rays.h"
#include "scene/analytic_scenes.h"

namespace unshot {
namespace {

// Three rooms in a row, of which the one in the middle has a lamp, with a block on its floor.
Mesh rooms(bool dark_sides) {
  SceneBuilder b;
  const auto grey = b.material("grey", glm::dvec3(0.5)),
             lamp = b.material("lamp", glm::dvec3(0.5), glm::dvec3(1.0));
  for (const double x : {0.0, 3.0, 6.0}) {
    addBox(b, allOf(grey), {x, 0, 0}, {2, 2, 2}, true);
    addBox(b, allOf(grey), {x + 0.5, 0, 0.5}, {0.5, 0.5, 0.5}, false);
    if (x == 3) b.quad(lamp, {x + 1, 1.9, 1}, {0.5, 0, 0}, {0, 0, 0.5});
  }
  return buildMesh(b.finish(), {.elements = 200, .element_size = {}, .dark_sides = dark_sides});
}

// Walls, block and lamp; the bottom of the block lies on the floor.
constexpr std::size_t kLitSurfaces = 6 + 5 + 1, kSurfaces = 3 * 12 + 1;

TEST(Lit, TrianglesComeFirst) {
  const Mesh mesh = rooms(false);
  ASSERT_EQ(mesh.surfaces.size(), kSurfaces);
  ASSERT_EQ(mesh.triangles.size(), 2 * kSurfaces);
  EXPECT_EQ(litTriangles(mesh).size(), 2 * kLitSurfaces);
  std::vector<int> used(mesh.triangles.size(), 0);
  for (const Surface& surface : mesh.surfaces) {
    EXPECT_EQ(isLit(surface), surface.triangles.end() <= 2 * kLitSurfaces);
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      ++used[t];
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3& p = mesh.positions[mesh.triangles[t].position[k]];
        EXPECT_LT(glm::distance(surface.point(mesh.triangles[t].uv[k]), p), 1e-12);
      }
    }
  }
  EXPECT_EQ(used, std::vector<int>(mesh.triangles.size(), 1));
}

TEST(Lit, AreAllWhereNothingIsLeftOut) { EXPECT_EQ(litTriangles(rooms(true)).size(), 2 * kSurfaces); }

TEST(Lit, SurfacesAloneAreMetByRays) {
  const Mesh mesh = rooms(false);
  const MeshRays rays(mesh);
  const auto meets = [&](const glm::dvec3& from) {
    return rays.intersect(from - mesh.frame_origin, glm::dvec3(0, -1, 0));
  };
  EXPECT_FALSE(meets({1.5, 1, 1.5}));
  EXPECT_FALSE(meets({7.5, 1, 1.5}));
  const auto hit = meets({4.5, 1, 1.2});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->at.distance, 1, 1e-9);
  EXPECT_TRUE(isLit(mesh.surfaces[hit->surface]));
  EXPECT_EQ(mesh.sides[hit->side].surface, hit->surface);
}

}  // namespace
}  // namespace unshot
