// A mesh in fewer triangles, for pictures that are to come soon: blocks of whole cells are drawn as two each,
// with the light at their corners. What cells are cut by stays as it is, and so does what has no grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"
#include "render/triangle_blocks.h"

namespace unshot {

struct MergedTriangles {
  std::uint64_t cut = 0;  ///< Mesh::cut
  /// In Mesh::vertices, three a triangle, wound as those of the mesh; null where they would be no fewer.
  std::shared_ptr<const std::vector<std::uint32_t>> corners;
  /// The element that each triangle stands for, or one of those; null where corners are.
  std::shared_ptr<const std::vector<std::uint32_t>> elements;
  TriangleBlocks blocks;  ///< of these
};

/// Merges blocks of 2 x 2 cells or, where that leaves more than `most` triangles, 4 x 4 or 8 x 8. Any thread.
/// Throws Cancelled.
MergedTriangles mergeTriangles(const Mesh& mesh, std::size_t most, const CancelToken& cancel = {});

}  // namespace unshot
