#include "render/patch_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/colour.h"
#include "mesh/build.h"
#include "scene/analytic_scenes.h"

namespace unshot {
namespace {

/// Pairs of patches with a display vertex in common and the same colour.
std::size_t confused(const Mesh& mesh, const std::vector<std::uint8_t>& colours) {
  std::vector<std::set<std::uint32_t>> at(mesh.vertices.size());
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k)
    at[mesh.triangle_vertices[k]].insert(mesh.element_patch[mesh.triangle_element[k / 3]]);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& patches : at) {
    for (const std::uint32_t a : patches) {
      for (const std::uint32_t b : patches) {
        if (a < b && colours[a] == colours[b]) pairs.emplace(a, b);
      }
    }
  }
  return pairs.size();
}

TEST(PatchColours, NeighboursHaveDifferentOnes) {
  const Mesh mesh = buildMesh(cubeOneFaceLit(0.5), {.elements = 3000, .element_size = {}});
  const std::vector<std::uint8_t> colours = patchColours(mesh);
  ASSERT_EQ(colours.size(), mesh.patch_count);
  ASSERT_GT(mesh.patch_count, 100u);
  EXPECT_EQ(confused(mesh, colours), 0u);
  EXPECT_EQ(std::set<std::uint8_t>(colours.begin(), colours.end()).size(), kPatchPalette.size())
      << "all are used";
  EXPECT_EQ(colours, patchColours(mesh));
}

// Half of a step of lightness (L* of CIE 1976) or of hue lies between any two of them.
TEST(PatchColours, CanBeToldApart) {
  for (std::size_t a = 0; a < kPatchPalette.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const auto lightness = [](const glm::vec3& c) {
        return 116 * std::cbrt(luminance(glm::dvec3(c))) - 16;
      };
      const double lighter = std::abs(lightness(kPatchPalette[a]) - lightness(kPatchPalette[b]));
      const glm::vec3 x =
          kPatchPalette[a] / std::max(kPatchPalette[a].x + kPatchPalette[a].y + kPatchPalette[a].z, 1e-6f);
      const glm::vec3 y =
          kPatchPalette[b] / std::max(kPatchPalette[b].x + kPatchPalette[b].y + kPatchPalette[b].z, 1e-6f);
      EXPECT_TRUE(lighter > 10 || glm::length(x - y) > 0.2f)
          << a << " and " << b << ": " << lighter << " " << glm::length(x - y);
    }
  }
}

}  // namespace
}  // namespace unshot
