#include "render/unlit_surfaces.h"

namespace unshot {

UnlitSurfaces unlitSurfaces(const Mesh& mesh) {
  UnlitSurfaces out;
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    const Surface& surface = mesh.surfaces[s];
    if (surface.side[0] != kNone || surface.side[1] != kNone) continue;
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      for (const std::uint32_t corner : mesh.triangles[t].position) {
        out.corners.emplace_back(mesh.positions[corner]);
        out.of.push_back(static_cast<std::uint32_t>(out.surfaces.size()));
      }
    }
    out.surfaces.push_back(s);
  }
  return out;
}

}  // namespace unshot
