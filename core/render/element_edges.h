// The edges between elements, for drawing the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// Pairs of vertex indices: every edge of the display triangles but those inside an element. Throws
/// Cancelled.
std::vector<std::uint32_t> elementEdges(const Mesh& mesh, const CancelToken& cancel = {});

}  // namespace unshot
