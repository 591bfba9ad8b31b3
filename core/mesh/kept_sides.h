// Which sides of surfaces have elements, and what can stand between two points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "mesh/build.h"
#include "mesh/contacts.h"
#include "mesh/mesh.h"
#include "mesh/surfaces.h"

namespace unshot {

/// Two flags for each surface: whether light may reach that side, which it does not where nothing of the
/// scene lies in front of it (and its own meets nothing then), nor where surfaces keep it away
/// (mesh/reach.h). And in which rooms these are.
struct KeptSides {
  std::vector<char> keep;
  std::vector<std::uint32_t> rooms;
};

/// `edges`: all edges of the scene's polygons, equal ones side by side. Fills in Surface::outer and
/// Mesh::closed.
KeptSides sidesToKeep(const MeshOptions& options, const std::vector<SurfaceEdge>& edges,
                      std::span<const Crossing> crossings, Mesh& mesh, const CancelToken& cancel);

/// Fills in Surface::between. If all of a room lies on one side of the planes of all surfaces around it, it
/// lies on the border of a convex body, and a line of sight between two of its points stays inside.
void findBetween(bool sky, Mesh& mesh, const CancelToken& cancel);

}  // namespace unshot
