// What shows the mesh itself, and takes long to find where it is large: edges between elements, colours that
// tell patches apart.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"
#include "render/display_modes.h"

namespace unshot {

struct MeshMarks {
  std::shared_ptr<const std::vector<std::uint32_t>> edges;         ///< elementEdges; null: not wanted
  std::shared_ptr<const std::vector<std::uint8_t>> patch_colours;  ///< patchColours; the same
};

/// Those that the mode shows. Any thread. Throws Cancelled.
MeshMarks findMeshMarks(const Mesh& mesh, const DisplayMode& mode, const CancelToken& cancel = {});

}  // namespace unshot
