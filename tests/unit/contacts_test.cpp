// Contacts: elements, display vertices and interpolation do not reach across the line where a block stands on
// a floor.
#include "mesh/contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "mesh/build.h"
#include "mesh/clip.h"
#include "support/dice.h"
#include "support/mesh_checks.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

using Polygon2 = std::vector<glm::dvec2>;

double area(const Polygon2& p) {
  double twice = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const glm::dvec2 a = p[k], b = p[(k + 1) % p.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

// What of `p` lies in the counter-clockwise convex polygon `window`.
Polygon2 intersection(Polygon2 p, const Polygon2& window) {
  for (std::size_t k = 0; k < window.size() && !p.empty(); ++k) {
    const glm::dvec2 a = window[k], d = window[(k + 1) % window.size()] - a;
    const auto height = [&](const glm::dvec2& x) { return d.x * (x.y - a.y) - d.y * (x.x - a.x); };
    Polygon2 next;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const glm::dvec2 u = p[i], v = p[(i + 1) % p.size()];
      const double hu = height(u), hv = height(v);
      if (hu >= 0) next.push_back(u);
      if ((hu > 0 && hv < 0) || (hu < 0 && hv > 0)) next.push_back(u + hu / (hu - hv) * (v - u));
    }
    p.swap(next);
  }
  return p;
}

struct Floor {
  Mesh mesh;
  const Surface* surface = nullptr;
  std::vector<double> covered;  // per local element: the share of it that lies under the block
};

class BlockOnFloor : public testing::TestWithParam<double> {
 protected:
  static Floor make(double angle, std::uint64_t elements) {
    const Scene scene = blockOnFloor(angle);
    Floor out;
    out.mesh = buildMesh(scene, {elements, {}, false});
    out.surface = &*std::find_if(out.mesh.surfaces.begin(), out.mesh.surfaces.end(),
                                 [](const Surface& s) { return s.material == 0; });
    Polygon2 foot;
    for (const glm::dvec3& p : blockFootprint(angle))
      foot.push_back(out.surface->chart(p - scene.frame_origin));
    if (area(foot) < 0) std::reverse(foot.begin(), foot.end());
    const Surface& s = *out.surface;
    out.covered.assign(s.elements.count, 0.0);
    for (std::uint32_t c = s.first_cell; c < s.first_cell + s.nu * s.nv; ++c) {
      for (std::uint32_t p = out.mesh.cells[c].pieces.first; p < out.mesh.cells[c].pieces.end(); ++p) {
        Polygon2 piece;
        const Range corners = out.mesh.pieces[p].corners;
        for (std::uint32_t k = corners.first; k < corners.end(); ++k)
          piece.push_back(out.mesh.piece_corners[k].uv);
        const std::uint32_t e = out.mesh.pieces[p].element;
        const Polygon2 under = intersection(piece, foot);
        if (!under.empty()) out.covered[e] += area(under) / out.mesh.shapes[s.elements.first + e].area;
      }
    }
    return out;
  }
};

// Cuts are exact to the welding distance, a millionth of the scene; along the border of an element that is
// 1e-4 of its area.
TEST_P(BlockOnFloor, CutsElementsAlongItsFootprint) {
  for (const std::uint64_t elements : {150u, 600u, 5000u}) {
    const Floor floor = make(GetParam(), elements);
    double under = 0;
    for (std::size_t e = 0; e < floor.covered.size(); ++e) {
      EXPECT_NEAR(floor.covered[e], floor.covered[e] < 0.5 ? 0 : 1, 1e-4)
          << "element " << e << " of " << elements;
      under += floor.covered[e] * floor.mesh.shapes[floor.surface->elements.first + e].area;
    }
    EXPECT_NEAR(under, 1.4 * 0.9, 1e-5);
    expectSoundMesh(floor.mesh);
    expectNoVertexWithinAnEdge(floor.mesh, 1e-6 * glm::length(floor.mesh.bounds_max - floor.mesh.bounds_min));
  }
}

TEST_P(BlockOnFloor, SharesNoVertexAndNoWeightAcrossIt) {
  for (const std::uint64_t elements : {150u, 5000u}) {
    const Floor floor = make(GetParam(), elements);
    const Mesh& mesh = floor.mesh;
    const auto isUnder = [&](std::uint32_t element) {
      const Side& side = mesh.sides[mesh.element_side[element]];
      return floor.covered[element - side.first_element] > 0.5;
    };
    const auto onFloorSide = [&](std::uint32_t element) {
      return &mesh.surfaces[mesh.sides[mesh.element_side[element]].surface] == floor.surface;
    };
    std::map<std::uint32_t, bool> under;  // of each vertex that floor elements use
    for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k) {
      const std::uint32_t element = mesh.triangle_element[k / 3];
      if (!onFloorSide(element)) continue;
      const auto [entry, fresh] = under.emplace(mesh.triangle_vertices[k], isUnder(element));
      EXPECT_EQ(entry->second, isUnder(element)) << "vertex " << entry->first;
    }
    const SparseRows& rows = mesh.vertex_from_elements;
    for (const auto& [vertex, is_under] : under) {
      for (std::uint32_t k = rows.start[vertex]; k < rows.start[vertex + 1]; ++k) {
        EXPECT_EQ(isUnder(rows.index[k]), is_under) << "weight of vertex " << vertex;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, BlockOnFloor, testing::Values(0.0, 0.3, 0.785), [](const auto& row) {
  return "Turned" + std::to_string(static_cast<int>(1000 * row.param));
});

TEST(Contacts, CutAFloorAlongAWallThatEndsInItsMiddle) {
  SceneBuilder b;
  const auto m = b.material("m", glm::dvec3(0.5)), wall = b.material("w", glm::dvec3(0.5));
  b.quad(m, onFloor(0, 0), onFloor(0, 3), onFloor(3, 0));
  b.quad(wall, onFloor(1.05, 0), onFloor(0, 2), {0, 1, 0});
  const Mesh mesh = buildMesh(b.finish(), {200, {}, false});
  expectSoundMesh(mesh);
  // Left and right of the wall, elements are different ones.
  const Surface& s = mesh.surfaces[0];
  for (double z = 0.05; z < 1.6; z += 0.1) {
    const auto at = [&](double x) { return elementAt(mesh, s, s.chart(onFloor(x, z) - mesh.frame_origin)); };
    const double y = mesh.frame_origin.y;
    const auto chart = [&](double x) { return s.chart(glm::dvec3(x, y, z) - mesh.frame_origin); };
    EXPECT_NE(elementAt(mesh, s, chart(1.04)), elementAt(mesh, s, chart(1.06))) << z;
    EXPECT_EQ(at(1.04), elementAt(mesh, s, chart(1.04)));
  }
}

// Walls shorter than a cell: some end inside one, some cross from one into the next.
TEST(Contacts, LeaveNoCracksWhereWallsEndInsideCells) {
  Dice dice(10);
  for (int k = 0; k < 20; ++k) {
    SceneBuilder b;
    const auto m = b.material("m", glm::dvec3(0.5)), wall = b.material("w", glm::dvec3(0.5));
    b.quad(m, onFloor(0, 0), onFloor(0, 3), onFloor(3, 0));
    for (int w = 0; w < 3; ++w) {
      const double turn = dice.between(0, 6.3);
      b.quad(wall, onFloor(dice.between(0.5, 2.5), dice.between(0.5, 2.5)),
             dice.between(0.01, 0.3) * onFloor(std::cos(turn), std::sin(turn)), {0, 1, 0});
    }
    const Mesh mesh = buildMesh(b.finish(), {200, {}, false});
    expectSoundMesh(mesh);
    expectNoVertexWithinAnEdge(mesh, 1e-6 * glm::length(mesh.bounds_max - mesh.bounds_min));
  }
}

// Elements of a floor of 3 by 3 on the two sides of x = 1.05, all along z up to `until`, are different ones.
bool isCutAlong(const Mesh& mesh, double until) {
  const Surface& s = mesh.surfaces[0];
  const auto at = [&](double x, double z) {
    return elementAt(mesh, s, s.chart(onFloor(x, z) - mesh.frame_origin));
  };
  for (double z = 0.05; z < until; z += 0.1) {
    if (at(1.04, z) == at(1.06, z)) return false;
  }
  return true;
}

Mesh floorWithWall(const glm::dvec3& corner, const glm::dvec3& along, const glm::dvec3& up) {
  SceneBuilder b;
  const auto m = b.material("m", glm::dvec3(0.5)), wall = b.material("w", glm::dvec3(0.5));
  b.quad(m, onFloor(0, 0), onFloor(0, 3), onFloor(3, 0));
  b.quad(wall, corner, along, up);
  Mesh mesh = buildMesh(b.finish(), {200, {}, false});
  expectSoundMesh(mesh);
  return mesh;
}

TEST(Contacts, AreFoundWhereASurfacePassesThroughAnother) {
  EXPECT_TRUE(isCutAlong(floorWithWall({1.05, -0.7, -0.5}, {0, 0, 4}, {0, 1.5, 0}), 3));
  EXPECT_TRUE(isCutAlong(floorWithWall({1.05, -0.7, 0}, {0, 0, 2}, {0, 1.5, 0}), 1.7));
}

// An element's edge is about a third here.
TEST(Contacts, AreFoundWhereLongEdgesComeNear) {
  EXPECT_TRUE(isCutAlong(floorWithWall({1.05, 0.001, 0}, {0, 0, 2}, {0, 1, 0}), 1.7));
  EXPECT_TRUE(isCutAlong(floorWithWall({1.05, 0.04, 0}, {0, 0, 2}, {1, 0, 0}), 1.7));
  const Mesh above = floorWithWall({1.05, 0.15, 0}, {0, 0, 2}, {0, 1, 0}),
             small = floorWithWall({1.05, 0.001, 0}, {0, 0, 0.2}, {0, 0.2, 0});
  for (const Mesh* mesh : {&above, &small}) {
    for (std::uint32_t c = 0; c < mesh->surfaces[0].nu * mesh->surfaces[0].nv; ++c)
      EXPECT_NE(mesh->cells[mesh->surfaces[0].first_cell + c].element, kMixed);
  }
}

// A wall of two triangles crosses a floor in two segments, which may meet within a cell.
TEST(Contacts, SegmentsThatMeetCutTogether) {
  std::vector<ConvexPolygon> polygons{{{{0, 0}, false}, {{1, 0}, false}, {{1, 1}, false}, {{0, 1}, false}}};
  cutByContacts(polygons, {{{0.3, -1}, {0.3, 0.4}}, {{0.3, 2}, {0.3, 0.4}}}, 1e-9);
  ASSERT_EQ(polygons.size(), 2u);
  for (const ConvexPolygon& p : polygons) {
    EXPECT_EQ(std::count_if(p.begin(), p.end(), [](const PieceCorner& c) { return c.outline; }), 1);
  }
  polygons = {{{{0, 0}, false}, {{1, 0}, false}, {{1, 1}, false}, {{0, 1}, false}}};
  cutByContacts(polygons, {{{0.3, -1}, {0.3, 0.4}}, {{0.3, 2}, {0.3, 0.6}}}, 1e-9);
  for (const ConvexPolygon& p : polygons) {
    EXPECT_EQ(std::count_if(p.begin(), p.end(), [](const PieceCorner& c) { return c.outline; }), 0);
  }
}

TEST(Contacts, CutAConvexPolygonIntoPartsThatAddUp) {
  std::vector<ConvexPolygon> polygons{{{{0, 0}, false}, {{1, 0}, false}, {{1, 1}, false}, {{0, 1}, false}}};
  cutByContacts(polygons, {{{0.3, -1}, {0.3, 2}}, {{-1, 0.2}, {2, 0.6}}, {{5, 5}, {6, 6}}}, 1e-9);
  ASSERT_EQ(polygons.size(), 4u);
  double sum = 0, cut_length = 0;
  for (const ConvexPolygon& p : polygons) {
    sum += polygonArea(p);
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (p[k].outline) cut_length += glm::distance(p[k].uv, p[(k + 1) % p.size()].uv);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  // Each cut is the outline of the parts on either side of it.
  EXPECT_NEAR(cut_length, 2 * (1 + std::hypot(1, 0.4 / 3)), 1e-12);
}

}  // namespace
}  // namespace unshot
