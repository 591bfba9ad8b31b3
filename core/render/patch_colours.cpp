#include "render/patch_colours.h"

namespace unshot {
namespace {

/// The display vertices of each patch, with repetitions.
struct PatchCorners {
  std::vector<std::uint32_t> first;  // one per patch and one more
  std::vector<std::uint32_t> vertex;
};

PatchCorners cornersOf(const Mesh& mesh) {
  PatchCorners out;
  out.first.assign(mesh.patch_count + 1, 0);
  const auto patchOf = [&](std::size_t triangle) {
    return mesh.element_patch[mesh.triangle_element[triangle]];
  };
  for (std::size_t t = 0; t < mesh.triangle_element.size(); ++t) out.first[patchOf(t) + 1] += 3;
  for (std::size_t q = 0; q < mesh.patch_count; ++q) out.first[q + 1] += out.first[q];
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
  out.vertex.resize(mesh.triangle_vertices.size());
  for (std::size_t k = 0; k < mesh.triangle_vertices.size(); ++k)
    out.vertex[next[patchOf(k / 3)]++] = mesh.triangle_vertices[k];
  return out;
}

}  // namespace

std::vector<std::uint8_t> patchColours(const Mesh& mesh, const CancelToken& cancel) {
  const PatchCorners corners = cornersOf(mesh);
  const std::uint32_t count = kPatchPalette.size();
  std::vector<std::uint32_t> taken(mesh.vertices.size(), 0);  // a bit for each colour
  std::vector<std::uint8_t> out(mesh.patch_count, 0);
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    cancel.check();
    std::uint32_t around = 0;
    for (std::uint32_t k = corners.first[q]; k < corners.first[q + 1]; ++k)
      around |= taken[corners.vertex[k]];
    // All of them are used alike: each patch begins to look at another one.
    std::uint32_t colour = q * 7 % count;
    for (std::uint32_t tries = 1; tries < count && (around >> colour & 1u) != 0; ++tries)
      colour = (colour + 1) % count;
    out[q] = static_cast<std::uint8_t>(colour);
    for (std::uint32_t k = corners.first[q]; k < corners.first[q + 1]; ++k)
      taken[corners.vertex[k]] |= 1u << colour;
  }
  return out;
}

}  // namespace unshot
