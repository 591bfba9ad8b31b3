// Meshes of surfaces of many shapes: areas, slivers, counts, and that hostile shapes end.
#include "mesh/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "mesh/build.h"
#include "support/dice.h"
#include "support/mesh_checks.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Surfaces alone in space: both their sides are kept.
Scene rectangle(double width, double height) {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.quad(0, onFloor(0, 0), onFloor(0, height), onFloor(width, 0));
  return b.finish();
}

Scene lShape() {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.polygon(0, {onFloor(0, 0), onFloor(0, 2), onFloor(1, 2), onFloor(1, 1), onFloor(3, 1), onFloor(3, 0)});
  return b.finish();
}

Scene triangle(double apex) {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.polygon(0, {onFloor(0, 0), onFloor(apex, 1), onFloor(2, 0)});
  return b.finish();
}

// A ring of eight trapezoids around an octagonal hole, with a notch: concave outside, hole inside.
Scene ringWithHole() {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  const auto at = [](int k, double radius) {
    const double t = k * std::acos(-1.0) / 4;
    return onFloor(radius * std::cos(t), -radius * std::sin(t));  // counter-clockwise from above
  };
  for (int k = 0; k < 8; ++k) {
    const double outer = k % 2 ? 1.4 : 2.0, next = k % 2 ? 2.0 : 1.4;
    b.polygon(0, {at(k, 0.6), at(k, outer), at(k + 1, next), at(k + 1, 0.6)});
  }
  return b.finish();
}

struct Shape {
  const char* name;
  Scene (*make)();
};

const Shape kShapes[] = {{"Square", [] { return rectangle(1, 1); }},
                         {"Rectangle", [] { return rectangle(3, 0.7); }},
                         {"LShape", lShape},
                         {"Triangle", [] { return triangle(0.3); }},
                         {"ObtuseTriangle", [] { return triangle(5); }},
                         {"RingWithHole", ringWithHole}};

class OneSurface : public testing::TestWithParam<Shape> {};

TEST_P(OneSurface, KeepsItsAreaAtEveryFinenessAndOrientation) {
  Dice dice(7);
  for (const std::uint64_t elements : {2u, 8u, 30u, 500u, 4000u}) {
    const Scene scene = moved(GetParam().make(), dice.rotation(), dice.between(0.01, 100), dice.inCube(5));
    const Mesh mesh = buildMesh(scene, {elements, {}, false});
    ASSERT_EQ(mesh.surfaces.size(), 1u);
    EXPECT_EQ(mesh.sides.size(), 2u);
    expectSoundMesh(mesh);
    expectNoVertexWithinAnEdge(mesh, 1e-6 * glm::length(mesh.bounds_max - mesh.bounds_min));
  }
}

// A sliver is joined to a neighbour, which is at most a full cell and has other slivers; so elements lie
// between kSliverShare and a few cells.
TEST_P(OneSurface, HasNoSlivers) {
  for (const std::uint64_t elements : {60u, 500u, 4000u}) {
    const Mesh mesh = buildMesh(GetParam().make(), {elements, {}, false});
    const Surface& s = mesh.surfaces[0];
    const double cell = s.extent.x * s.extent.y / (s.nu * s.nv);
    const auto [least, most] = std::minmax_element(mesh.element_area.begin(), mesh.element_area.end());
    EXPECT_GE(*least, 0.999 * kSliverShare * cell) << elements;
    EXPECT_LE(*most, 3.5 * cell) << elements;
  }
}

// Cells are as near to squares as whole numbers of them allow.
TEST_P(OneSurface, HasNearlySquareCells) {
  const Mesh mesh = buildMesh(GetParam().make(), {1000, {}, false});
  const Surface& s = mesh.surfaces[0];
  const double ratio = s.extent.x / s.nu / (s.extent.y / s.nv);
  EXPECT_GT(ratio, 0.9);
  EXPECT_LT(ratio, 1.1);
}

TEST_P(OneSurface, HasAboutAsManyElementsAsAskedFor) {
  for (const std::uint64_t elements : {200u, 1000u, 5000u}) {
    const Mesh mesh = buildMesh(GetParam().make(), {elements, {}, false});
    EXPECT_NEAR(mesh.element_count, static_cast<double>(elements), 0.1 * static_cast<double>(elements));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, OneSurface, testing::ValuesIn(kShapes),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Grid, CutsAnAxisParallelRectangleIntoFullCells) {
  const Mesh mesh = buildMesh(rectangle(2, 1), {{}, 0.1, false});
  EXPECT_EQ(mesh.surfaces[0].nu * mesh.surfaces[0].nv, 200u);
  EXPECT_EQ(mesh.element_count, 400u);
  for (const double area : mesh.element_area) EXPECT_NEAR(area, 0.01, 1e-12);
}

TEST(Grid, FindsTheElementAtAPosition) {
  Dice dice(8);
  const Mesh mesh = buildMesh(ringWithHole(), {2000, {}, false});
  const Surface& s = mesh.surfaces[0];
  for (const Piece& piece : mesh.pieces) {
    // A random point inside a convex piece: a mean of its corners with positive weights.
    glm::dvec2 sum(0.0);
    double weights = 0;
    for (std::uint32_t k = piece.corners.first; k < piece.corners.end(); ++k) {
      const double w = dice.between(0.1, 1);
      sum += w * mesh.piece_corners[k].uv;
      weights += w;
    }
    EXPECT_EQ(elementAt(mesh, s, sum / weights), piece.element);
  }
}

class CornellCount : public testing::TestWithParam<std::uint64_t> {};

TEST_P(CornellCount, IsWithinATenthOfWhatIsAskedFor) {
  const auto wanted = static_cast<double>(GetParam());
  const Mesh mesh = buildMesh(publishedCornellBox(), {GetParam(), {}, false});
  EXPECT_NEAR(mesh.element_count, wanted, 0.1 * wanted);
  expectSoundMesh(mesh);
}

INSTANTIATE_TEST_SUITE_P(Elements, CornellCount, testing::Values(300u, 1000u, 10'000u, 50'000u),
                         [](const auto& row) { return std::to_string(row.param); });

TEST(Grid, EndsOnAStripTenThousandTimesLongerThanWide) {
  for (const std::uint64_t elements : {100u, 5000u}) {
    expectAreasAddUp(buildMesh(rectangle(10, 0.001), {elements, {}, false}));
    SceneBuilder b;
    b.material("m", glm::dvec3(0.5));
    b.quad(0, onFloor(0, 0), onFloor(0, 10), onFloor(10, 0));
    b.quad(0, {0, 1, 0}, onFloor(0, 0.001), onFloor(10, 0));
    const Mesh mesh = buildMesh(b.finish(), {elements, {}, false});
    expectAreasAddUp(mesh);
    EXPECT_NEAR(mesh.element_count, static_cast<double>(elements), 0.1 * static_cast<double>(elements));
  }
}

TEST(Grid, EndsOnAFanOfNeedles) {
  for (const bool one_material : {true, false}) {
    SceneBuilder b;
    b.material("a", glm::dvec3(0.5));
    b.material("b", glm::dvec3(0.5));
    for (int k = 0; k < 200; ++k) {
      const double t0 = k * 0.001, t1 = (k + 1) * 0.001;
      b.polygon(one_material || k % 2 ? 0u : 1u,
                {onFloor(0, 0), onFloor(10 * std::sin(t0), 10 * std::cos(t0)),
                 onFloor(10 * std::sin(t1), 10 * std::cos(t1))});
    }
    const Mesh mesh = buildMesh(b.finish(), {2000, {}, false});
    EXPECT_EQ(mesh.surfaces.size(), one_material ? 1u : 200u);
    expectAreasAddUp(mesh);
    expectDisplayCovers(mesh);
  }
}

TEST(BuildMesh, RefusesImpossibleFineness) {
  const auto kindOf = [](const MeshOptions& options) {
    try {
      buildMesh(rectangle(1, 1), options);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::kInternal;
  };
  EXPECT_EQ(kindOf({0, {}, false}), ErrorKind::kUsage);
  EXPECT_EQ(kindOf({{}, 0.0, false}), ErrorKind::kUsage);
  EXPECT_EQ(kindOf({{}, -1.0, false}), ErrorKind::kUsage);
  EXPECT_EQ(kindOf({{}, NAN, false}), ErrorKind::kUsage);
  EXPECT_EQ(kindOf({{}, INFINITY, false}), ErrorKind::kUsage);
  EXPECT_EQ(kindOf({10, 0.5, false}), ErrorKind::kUsage);
  EXPECT_EQ(kindOf({{}, 1e-7, false}), ErrorKind::kUsage);
}

TEST(BuildMesh, RefusesASceneWithoutArea) {
  SceneBuilder b;
  b.material("m", glm::dvec3(0.5));
  b.polygon(0, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_THROW(buildMesh(b.finish(), {}), Error);
}

TEST(BuildMesh, GivesElementsOnlyToSidesThatLightCanReach) {
  const Mesh cube = buildMesh(furnaceScene(0.5, 0.5), {600, {}, false});
  EXPECT_EQ(cube.sides.size(), 6u);
  for (const Side& side : cube.sides) EXPECT_FALSE(side.back);
  // The lit one of two rooms, and both sides of its light.
  MeshOptions options;
  options.elements = 600;
  EXPECT_EQ(buildMesh(litAndDarkRoom(), options).sides.size(), 6u + 2u);
  options.dark_sides = true;
  EXPECT_EQ(buildMesh(litAndDarkRoom(), options).sides.size(), 8u + 2u + 2u + 2u);
}

TEST(BuildMesh, LetsBackSidesEmitUnlessToldNotTo) {
  for (const bool front_only : {false, true}) {
    const Mesh mesh = buildMesh(litAndDarkRoom(), {600, {}, front_only});
    int emitting = 0;
    for (const Side& side : mesh.sides) emitting += side.emission.x > 0;
    EXPECT_EQ(emitting, front_only ? 1 : 2);
  }
}

TEST(Grid, SaysWhereAScaleIsBeyondSinglePrecision) {
  const auto said = [](double edge) {
    const Mesh mesh =
        buildMesh(rectangle(edge, edge), {.elements = 10, .element_size = {}, .emit_front_only = false});
    return std::count_if(mesh.diagnostics.begin(), mesh.diagnostics.end(),
                         [](const Diagnostic& d) { return d.code == "extreme-size"; });
  };
  for (const double edge : {1e-12, 1.0, 1e12}) EXPECT_EQ(said(edge), 0) << edge;
  for (const double edge : {1e-35, 1e35}) EXPECT_EQ(said(edge), 1) << edge;
}

}  // namespace
}  // namespace unshot
