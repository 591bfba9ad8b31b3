// Display triangles and vertices of a gridded mesh, without cracks: vertices of neighbours that lie on a
// piece's edge become its corners; interpolation from the elements around each vertex.
#pragma once

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// Fills patch_air, vertices, triangle_vertices, triangle_element and vertex_from_elements.
void makeDisplay(Mesh& mesh, const CancelToken& cancel = {});

}  // namespace unshot
