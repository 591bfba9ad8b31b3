// Display triangles: no cracks, shared vertices where light is continuous and only there, interpolation that
// keeps constants.
#include "mesh/display.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "mesh/build.h"
#include "support/dice.h"
#include "support/mesh_checks.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

double weldMargin(const Mesh& mesh) { return 1e-6 * glm::length(mesh.bounds_max - mesh.bounds_min); }

// A closed room whose floor is of three materials, so that neighbours are divided differently and meet in
// T-vertices.
Scene patchworkRoom() {
  SceneBuilder b;
  for (const char* name : {"a", "b", "c", "wall"}) b.material(name, glm::dvec3(0.5), glm::dvec3(0.1));
  b.quad(0, onFloor(0, 0), onFloor(0, 1.3), onFloor(0.7, 0));
  b.quad(1, onFloor(0.7, 0), onFloor(0, 0.45), onFloor(1.3, 0));
  b.quad(2, onFloor(0.7, 0.45), onFloor(0, 0.85), onFloor(1.3, 0));
  addBox(b, {3, 3, kNone, 3, 3, 3}, {0, 0, 0}, {2, 1, 1.3}, true);
  return b.finish();
}

TEST(Display, HasNoCracksInAClosedRoomWhateverTheFineness) {
  Dice dice(9);
  for (const auto& make : {+[] { return furnaceScene(0.5, 0.5); }, patchworkRoom, lShapedRoom}) {
    for (const std::uint64_t elements : {7u, 100u, 1700u}) {
      const Scene scene = moved(make(), dice.rotation(), dice.between(0.1, 10));
      const Mesh mesh = buildMesh(scene, {elements, {}, false});
      expectClosed(mesh, [](const Side& side) { return !side.back; });
      expectNoVertexWithinAnEdge(mesh, weldMargin(mesh));
      expectSoundMesh(mesh);
    }
  }
}

TEST(Display, HasNoCracksInTheCornellBox) {
  for (const std::uint64_t elements : {300u, 3000u}) {
    const Mesh mesh = buildMesh(publishedCornellBox(), {elements, {}, false});
    expectNoVertexWithinAnEdge(mesh, weldMargin(mesh));
  }
}

TEST(Display, HasNoCracksInASphere) {
  for (const std::uint64_t elements : {500u, 4000u}) {
    const Mesh mesh = buildMesh(concentricSpheres(0.5, 1, 0.5, 0, 8), {elements, {}, false});
    expectClosed(mesh, [](const Side&) { return true; });
    expectSoundMesh(mesh);
  }
}

// Within a surface pieces that share an edge share its vertices: a rectangle of n x m cells has (n + 1)(m +
// 1) of them a side.
TEST(Display, SharesVerticesWithinASurface) {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.quad(0, onFloor(0, 0), onFloor(0, 1), onFloor(1, 0));
  b.quad(0, onFloor(1, 0), onFloor(0, 1), onFloor(1, 0));
  const Mesh mesh = buildMesh(b.finish(), {{}, 0.125, false});
  EXPECT_EQ(mesh.surfaces.size(), 1u);
  // The polygons meet in the middle, which is a line of the grid.
  EXPECT_EQ(mesh.vertices.size(), 2u * 17 * 9);
}

TEST(Display, DoublesVerticesAtASharpEdgeAndSharesThemAtASmoothOne) {
  // Inner sides of a cube meet at right angles: 6 faces of 5 x 5 vertices.
  EXPECT_EQ(buildMesh(furnaceScene(0.5, 0.5), {{}, 0.25, false}).vertices.size(), 6u * 25);
  // A sphere of 24 rings is smooth everywhere: no two vertices of one side at one place.
  const Mesh mesh = buildMesh(concentricSpheres(0.5, 1, 0.5, 0, 24), {2000, {}, false});
  std::set<std::tuple<float, float, float, bool>> places;
  for (const Vertex& v : mesh.vertices) {
    const float outwards = glm::dot(glm::normalize(v.position), v.normal);
    EXPECT_GT(std::abs(outwards), 0.98f);
    EXPECT_TRUE(places.emplace(v.position.x, v.position.y, v.position.z, outwards > 0).second);
  }
}

TEST(Display, NormalsOfAFlatSideAreTheSides) {
  const Mesh mesh = buildMesh(patchworkRoom(), {800, {}, false});
  for (const Vertex& v : mesh.vertices) {
    EXPECT_LT(glm::distance(glm::dvec3(v.normal), mesh.sides[v.side].normal), 1e-6);
  }
}

// Each triangle turns about the normal of its side.
TEST(Display, WindsTrianglesAsSeenFromTheirSide) {
  const Mesh mesh = buildMesh(publishedCornellBox(), {2000, {}, false});
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) {
    const std::uint32_t* corner = &mesh.triangle_vertices[3 * t];
    const glm::dvec3 a(mesh.vertices[corner[0]].position), b(mesh.vertices[corner[1]].position),
        c(mesh.vertices[corner[2]].position);
    const glm::dvec3 turned = glm::cross(b - a, c - a);
    if (glm::length(turned) < 1e-3)
      continue;  // thinner than the rounding of single precision (coordinates of 500)
    EXPECT_GT(glm::dot(turned, mesh.sides[mesh.element_side[mesh.triangle_element[t]]].normal), 0);
  }
}

// A vertex of a rectangle's grid takes its elements in equal shares, so a field linear in the plane is met
// exactly inside.
TEST(Display, InterpolatesALinearFieldExactlyAtInnerVerticesOfARectangle) {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.quad(0, onFloor(0, 0), onFloor(0, 1), onFloor(1, 0));
  const Mesh mesh = buildMesh(b.finish(), {{}, 0.1, false});
  const auto field = [](const glm::dvec3& p) { return 3 + 2 * p.x - 5 * p.z; };
  const SparseRows& rows = mesh.vertex_from_elements;
  int inner = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const glm::dvec3 p(mesh.vertices[v].position);
    if (std::max(std::abs(p.x), std::abs(p.z)) > 0.45) continue;
    double sum = 0;
    for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) {
      const std::uint32_t local = rows.index[k] - mesh.sides[mesh.element_side[rows.index[k]]].first_element;
      sum += static_cast<double>(rows.weight[k]) * field(mesh.shapes[local].centre);
    }
    EXPECT_NEAR(sum, field(p), 2e-6);
    ++inner;
  }
  EXPECT_EQ(inner, 2 * 81);
}

}  // namespace
}  // namespace unshot
