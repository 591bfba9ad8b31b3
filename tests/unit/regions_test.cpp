#include "formfactor/regions.h"

#include <gtest/gtest.h>

#include "mesh/build.h"
#include "mesh/grid.h"
#include "support/test_scenes.h"

namespace unshot {
namespace {

using namespace testing_support;

// Parts of parts, three levels down.
void expectPartsAddUp(const Mesh& mesh, const Region& region, int depth) {
  if (depth == 0) return;
  const std::vector<Region> parts = partsOf(mesh, region);
  double area = 0;
  for (const Region& part : parts) {
    EXPECT_GT(part.area, 0);
    EXPECT_EQ(part.surface, region.surface);
    area += part.area;
    const Surface& s = mesh.surfaces[part.surface];
    if (part.patch != kNone) {
      const std::uint32_t element = elementAt(mesh, s, part.sample);
      ASSERT_NE(element, kNone);
      EXPECT_EQ(mesh.shapes[s.elements.first + element].patch, part.patch);
    }
    expectPartsAddUp(mesh, part, depth - 1);
  }
  EXPECT_NEAR(area, region.area, 1e-9 * region.area);
}

TEST(Regions, OfPatchesHaveTheirAreaAndPartsThatAddUp) {
  for (const Scene& scene : {lShapedRoom(), blockOnFloor(0.3), publishedCornellBox()}) {
    const Mesh mesh = buildMesh(scene, {3000, {}, false});
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
      const Region region = regionOfPatch(mesh, q);
      // A patch that reaches into a neighbour's node with a joined sliver is shot from its own node alone.
      EXPECT_LE(region.area, mesh.patch_area[q] * (1 + 1e-9)) << "patch " << q;
      EXPECT_GE(region.area, mesh.patch_area[q] * 0.5) << "patch " << q;
      expectPartsAddUp(mesh, region, 3);
    }
  }
}

TEST(Regions, SampleAPointOfTheSurface) {
  const Mesh mesh = buildMesh(lShapedRoom(), {60, {}, false});
  for (std::uint32_t n = 0; n < mesh.nodes.size(); ++n) {
    const Region region = regionOfNode(mesh, n, kNone);
    if (region.area <= 0) continue;
    EXPECT_NE(elementAt(mesh, mesh.surfaces[region.surface], region.sample), kNone);
  }
}

}  // namespace
}  // namespace unshot
