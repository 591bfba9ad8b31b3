// Numbers elements and patches over all lit sides of a mesh.
#pragma once

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// Fills what is numbered over all sides (but patch_air), each side's first element and part of a patch, and
/// element_size, from the elements and patches of the surfaces. Each local patch of a side is a patch.
void numberElements(Mesh& mesh, const CancelToken& cancel = {});

}  // namespace unshot
