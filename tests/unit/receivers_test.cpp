#include "formfactor/receivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "mesh/build.h"
#include "mesh/grid.h"
#include "scene/obj_reader.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

class ReceiversOfAScene : public testing::TestWithParam<ReceiverKind> {};

// Vertices are in single precision, so their areas add up to 1e-6.
TEST_P(ReceiversOfAScene, DivideTheLitAreaAndEachPatchAmongThem) {
  for (const Scene& scene :
       {furnaceScene(0.5, 0.5), lShapedRoom(), blockOnFloor(0.3), publishedCornellBox()}) {
    const Mesh mesh = buildMesh(scene, {3000, {}, false});
    const Receivers receivers = makeReceivers(mesh, GetParam());
    ASSERT_EQ(receivers.start.size(), receivers.size() + 1);
    ASSERT_EQ(receivers.reflectance.size(), receivers.size());
    double area = 0;
    std::vector<double> of_patch(mesh.patch_count, 0.0);
    for (std::uint32_t v = 0; v < receivers.size(); ++v) {
      area += receivers.area[v];
      double shares = 0;
      for (std::uint32_t s = receivers.start[v]; s < receivers.start[v + 1]; ++s) {
        EXPECT_EQ(receivers.shares[s].receiver, v);
        shares += receivers.shares[s].area;
        of_patch[receivers.shares[s].patch] += receivers.shares[s].area;
        EXPECT_EQ(receivers.reflectance[v],
                  mesh.sides[mesh.patch_side[receivers.shares[s].patch]].reflectance);
      }
      EXPECT_NEAR(shares, receivers.area[v], 1e-12 * mesh.lit_area);
    }
    EXPECT_NEAR(area, mesh.lit_area, 1e-6 * mesh.lit_area);
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
      EXPECT_NEAR(of_patch[q], mesh.patch_area[q], 1e-4 * mesh.patch_area[q]) << "patch " << q;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ReceiversOfAScene,
                         testing::Values(ReceiverKind::kElements, ReceiverKind::kVertices),
                         [](const auto& row) {
                           return row.param == ReceiverKind::kElements ? "Elements" : "Vertices";
                         });

TEST(VertexReceivers, StandOffEdges) {
  const Mesh mesh = buildMesh(furnaceScene(0.5, 0.5), {600, {}, false});
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  ASSERT_EQ(receivers.view_start.size(), mesh.vertices.size() + 1);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto views = receivers.viewsOf(static_cast<std::uint32_t>(v));
    ASSERT_EQ(views.size(), 1u);
    EXPECT_NEAR(views[0].weight, 1, 1e-12);
    const glm::dvec3 p = views[0].position, vertex(mesh.vertices[v].position);
    const Side& side = mesh.sides[mesh.vertices[v].side];
    EXPECT_LT(glm::distance(p, vertex), 0.15 * mesh.element_size);
    for (int axis = 0; axis < 3; ++axis) {  // strictly inside the cube but for its own wall
      if (std::abs(side.normal[axis]) < 0.5) {
        EXPECT_LT(std::abs(p[axis]), 0.5);
      }
    }
  }
}

// At the corner of a block the mean of the elements around can lie under the block, where it is dark.
TEST(VertexReceivers, LookFromElementsAroundThem) {
  for (const std::uint64_t elements : {600u, 2'500u, 5'000u}) {
    for (const Scene& scene : {publishedCornellBox(), readObj(UNSHOT_SOURCE_DIR "/assets/cornell_box.obj")}) {
      const Mesh mesh = buildMesh(scene, {elements, {}, false});
      const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
      std::vector<std::set<std::uint32_t>> around(mesh.vertices.size());
      for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k)
        around[mesh.triangle_vertices[k]].insert(mesh.triangle_element[k / 3]);
      for (std::uint32_t v = 0; v < receivers.size(); ++v) {
        for (const ReceiverView& view : receivers.viewsOf(v)) {
          const Side& side = mesh.sides[view.side];
          const Surface& surface = mesh.surfaces[side.surface];
          const std::uint32_t local = elementAt(mesh, surface, surface.chart(view.position));
          ASSERT_NE(local, kNone);
          EXPECT_TRUE(around[v].contains(side.first_element + local))
              << "vertex " << v << " of " << elements << " elements";
        }
      }
    }
  }
}

// Or from each patch of several surfaces, along the mean of their normals.
TEST(VertexReceivers, LookFromEachSurfaceWhereSurfacesJoinSmoothly) {
  const Mesh mesh = buildMesh(concentricSpheres(0.5, 1, 0.5, 0, 12), {600, {}, false});
  const Receivers receivers = makeReceivers(mesh, ReceiverKind::kVertices);
  std::size_t most = 0;
  for (std::uint32_t v = 0; v < receivers.size(); ++v) {
    double weights = 0;
    for (const ReceiverView& view : receivers.viewsOf(v)) {
      const Surface& surface = mesh.surfaces[mesh.sides[view.side].surface];
      EXPECT_NEAR(glm::dot(view.position - surface.origin, surface.normal), 0, 1e-12);
      if (mesh.joined(view.patch)) {
        EXPECT_GT(glm::dot(view.normal, mesh.sides[view.side].normal), std::cos(0.7));
      } else {
        EXPECT_EQ(view.normal, mesh.sides[view.side].normal);
      }
      weights += view.weight;
    }
    EXPECT_NEAR(weights, 1, 1e-12);
    most = std::max(most, receivers.viewsOf(v).size());
  }
  EXPECT_GE(most, 3u);
}

}  // namespace
}  // namespace unshot
