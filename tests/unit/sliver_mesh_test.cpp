// Shapes near the weld distance and far from filling their charts: meshes of them stay small. What the fuzzer
// found.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "mesh/build.h"
#include "scene/analytic_scenes.h"
#include "scene/obj_reader.h"

namespace unshot {
namespace {

TEST(SliverMesh, OfAThinFrameHasNotManyEmptyCells) {
  constexpr double kSize = 100, kThickness = 0.01;
  SceneBuilder b;
  b.material("white", glm::dvec3(0.5));
  const glm::dvec3 x(kSize, 0, 0), y(0, kSize, 0), wide(kThickness, 0, 0), high(0, kThickness, 0);
  b.polygon(0, {{0, 0, 0}, x, x + high - wide, wide + high});
  b.polygon(0, {x, x + y, x + y - wide - high, x + high - wide});
  b.polygon(0, {x + y, y, y + wide - high, x + y - wide - high});
  b.polygon(0, {y, {0, 0, 0}, wide + high, y + wide - high});
  MeshOptions options;
  options.element_size = 0.05;
  const Mesh mesh = buildMesh(b.finish(), options);
  ASSERT_EQ(mesh.surfaces.size(), 1u);
  EXPECT_LE(mesh.cells.size(), 200'000u) << "4 million would fill the chart";
  EXPECT_GE(mesh.element_count, 100u);
  double sum = 0;
  for (const double area : mesh.element_area) sum += area;
  EXPECT_NEAR(sum, mesh.lit_area, 1e-3 * mesh.lit_area);
}

TEST(SliverMesh, BelowTheWeldDistanceAsksForNoEndlessFineness) {
  // The weld distance is a metre, a millionth of what lies between the triangle and the far one.
  SceneBuilder b;
  b.material("white", glm::dvec3(0.5));
  b.polygon(0, {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  b.polygon(0, {{1e6, 0, 0}, {1e6, 3, 0}, {1e6, 0, 3}});
  MeshOptions options;
  options.elements = 2'000;
  const Mesh mesh = buildMesh(b.finish(), options);
  EXPECT_LE(mesh.cells.size(), 40'000u);
}

TEST(SliverMesh, HasVerticesThatTakeFromFewElements) {
  const std::filesystem::path path =
      std::filesystem::path(UNSHOT_SOURCE_DIR) / "tests/fuzz/regressions/vertices_that_take_from_each_other";
  MeshOptions options;
  options.element_size = 10'000;
  const Mesh mesh = buildMesh(readObj(path), options);
  const SparseRows& rows = mesh.vertex_from_elements;
  ASSERT_EQ(rows.size(), mesh.vertices.size());
  std::size_t longest = 0;
  for (std::size_t v = 0; v < rows.size(); ++v) {
    longest = std::max<std::size_t>(longest, rows.start[v + 1] - rows.start[v]);
    float sum = 0;
    for (std::uint32_t k = rows.start[v]; k < rows.start[v + 1]; ++k) sum += rows.weight[k];
    EXPECT_NEAR(sum, 1, 1e-4f);
  }
  EXPECT_LE(longest, 200u);
}

}  // namespace
}  // namespace unshot
