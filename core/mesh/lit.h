// Surfaces that light reaches from either side, and those that it reaches from neither.
//
// The latter need not be known to transport: a line of sight between two lit points that met one would shine
// on it there, from the first of its points onwards. They stay among a mesh's surfaces for what shows or
// names them.
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace unshot {

inline bool isLit(const Surface& s) { return s.side[0] != kNone || s.side[1] != kNone; }

/// Reorders mesh.triangles so that those of lit surfaces come first, each part in the order it had.
void putLitTrianglesFirst(Mesh& mesh);

/// The first of mesh.triangles, up to the last one of a lit surface.
std::span<const ChartTriangle> litTriangles(const Mesh& mesh);

}  // namespace unshot
