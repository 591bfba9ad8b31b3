// Lays a grid over a surface: cells cut by its outline and contacts, slivers joined to their neighbours, the
// four-way tree above.
#pragma once

#include <vector>

#include "mesh/contacts.h"
#include "mesh/mesh.h"

namespace unshot {

/// Parts of cells with less than this share of a full cell's area join the neighbour they share the longest
/// border with. Below it, counted pixels make an element's value noisy; above it, joined elements would look
/// uneven.
inline constexpr double kSliverShare = 0.4;

/// Fills surface.nu, nv, cut, first_cell, root, elements and patches, appending to cells, pieces,
/// piece_corners, nodes, patch_shapes and shapes of the mesh. A patch spans at most patch_cells x patch_cells
/// cells; where `paired`, nodes are halved between pairs of cells. `tolerance` [m]: what is nearer than this
/// to a contact lies on it.
void gridSurface(Mesh& mesh, std::uint32_t surface, std::uint32_t nu, std::uint32_t nv,
                 std::uint32_t patch_cells, bool paired, const std::vector<ContactSegment>& contacts,
                 double tolerance, const CancelToken& cancel = {});

/// Sets the centres of the elements of the surface whose pieces were made last: the centroid or, where that
/// falls outside the element, the centre of its largest piece.
void placeCentres(Mesh& mesh, const Surface& surface, const CancelToken& cancel);

/// The cell (its index in Mesh::cells) at chart position uv, clamped to the grid.
inline std::uint32_t cellAt(const Surface& s, const glm::dvec2& uv) {
  const double x = uv.x / s.extent.x * s.nu, y = uv.y / s.extent.y * s.nv;
  const auto i = x > 0 ? (x < s.nu ? static_cast<std::uint32_t>(x) : s.nu - 1) : 0u;
  const auto j = y > 0 ? (y < s.nv ? static_cast<std::uint32_t>(y) : s.nv - 1) : 0u;
  return s.first_cell + j * s.nu + i;
}

/// The local element at chart position uv: the one that holds it or, outside the outline, the nearest in its
/// cell. kNone where the cell has no area, or where several elements lie within `margin` [m] of uv and none
/// is sure to hold it.
std::uint32_t elementAt(const Mesh& mesh, const Surface& s, const glm::dvec2& uv, double margin = 0);

}  // namespace unshot
