#include "formfactor/patch_polygons.h"

#include <gtest/gtest.h>

#include "mesh/build.h"
#include "stability/stability_scenes.h"

namespace unshot {
namespace {

double areaOf(const FactorPolygon& polygon) {
  const std::vector<glm::dvec3>& ring = polygon.corners();
  glm::dvec3 area(0.0);
  for (std::size_t k = 2; k < ring.size(); ++k)
    area += glm::cross(ring[k - 1] - ring[0], ring[k] - ring[0]) / 2.0;
  return glm::length(area);
}

// Where an outline or a contact cuts a cell so that little is left, the cell beside takes it, and its patch
// has a piece outside of its node.
TEST(PatchPolygons, HaveTheWholeAreaOfEachPatchWithItsSlivers) {
  for (Scene (*make)() : {concavePolygons, interpenetratingBlocks, needleFan, finsOnOneEdge}) {
    for (const std::uint64_t elements : {300u, 500u, 1200u}) {
      const Mesh mesh = buildMesh(make(), {elements, {}, false});
      const PatchPolygons polygons(mesh);
      for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
        double area = 0;
        for (const FactorPolygon& part : polygons.parts(q)) area += areaOf(part);
        EXPECT_NEAR(area / mesh.patch_area[q], 1, 1e-6) << "patch " << q << " of " << elements;
      }
    }
  }
}

}  // namespace
}  // namespace unshot
