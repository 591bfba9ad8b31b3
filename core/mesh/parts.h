// Which pieces of a grid hang together: parts of cells, and the borders that parts of neighbouring cells
// share.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// What hangs together in one cell, across edges that are not outline.
struct Part {
  std::uint32_t cell = 0;  ///< local: j nu + i
  double area = 0;
};

/// Two parts of neighbouring cells and the length of the border between them that is not outline [m].
struct PartBorder {
  std::uint32_t a = 0, b = 0;
  double length = 0;
};

struct PartGraph {
  std::vector<Part> parts;                ///< by cell
  std::vector<std::uint32_t> piece_part;  ///< part of each piece, counted from the surface's first piece
  std::vector<PartBorder> borders;
};

/// For a surface whose cells have their pieces.
PartGraph findParts(const Mesh& mesh, const Surface& surface, const CancelToken& cancel = {});

}  // namespace unshot
