// Parts of a patch to shoot from: of one that several surfaces make, those that lie together; what lies of
// a surface's patch in the nodes of the subdivision tree below it and, below the cells, in quarters of cells.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "mesh/clip.h"
#include "mesh/mesh.h"

namespace unshot {

/// A part of a surface's side, or of several, with area and a point on it to stand for it.
struct Region {
  std::vector<std::uint32_t> parts;  ///< in Mesh::patch_parts, where it is several; the rest is of the first
  std::uint32_t side = 0;
  std::uint32_t surface = 0;
  std::uint32_t patch = kNone;     ///< local patch that it is part of; kNone: whatever lies there
  std::uint32_t node = kNone;      ///< a node of the tree, or kNone below the cells
  std::uint32_t cell = kNone;      ///< below the cells: the one it lies in
  glm::dvec2 low{0.0}, high{0.0};  ///< rectangle in the chart
  double area = 0;                 ///< inside the outline [m^2]
  glm::dvec2 sample{0.0};          ///< on the surface, in the region: its centroid where that lies in it
};

Region regionOfPatch(const Mesh& mesh, std::uint32_t q);
/// What lies of local patch `patch` (kNone: of any) in the node, on either side.
Region regionOfNode(const Mesh& mesh, std::uint32_t node, std::uint32_t patch);
/// The region's parts that have area: halves of several, children of its node, or quarters of the rectangle.
std::vector<Region> partsOf(const Mesh& mesh, const Region& region);

}  // namespace unshot
