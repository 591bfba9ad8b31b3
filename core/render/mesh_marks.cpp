#include "render/mesh_marks.h"

#include "render/element_edges.h"
#include "render/patch_colours.h"

namespace unshot {

MeshMarks findMeshMarks(const Mesh& mesh, const DisplayMode& mode, const CancelToken& cancel) {
  MeshMarks marks;
  if (mode.edges)
    marks.edges = std::make_shared<const std::vector<std::uint32_t>>(elementEdges(mesh, cancel));
  if (mode.quantity == Quantity::kPatches)
    marks.patch_colours = std::make_shared<const std::vector<std::uint8_t>>(patchColours(mesh, cancel));
  return marks;
}

}  // namespace unshot
