// Display triangles and vertices of a gridded mesh, without cracks: vertices of neighbours that lie on a
// piece's edge become its corners; interpolation from the elements around each vertex.
#pragma once

#include <span>

#include "mesh/mesh.h"
#include "mesh/surfaces.h"

namespace unshot {

/// Fills patch_air, vertices, triangle_vertices, triangle_element and vertex_from_elements. Points closer
/// than `weld_distance` are one.
void makeDisplay(Mesh& mesh, std::span<const SmoothPair> smooth_pairs, double weld_distance,
                 const CancelToken& cancel = {});

}  // namespace unshot
