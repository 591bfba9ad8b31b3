// Contacts: where edges of other surfaces lie in a surface's plane, inside its outline (a block on a floor, a
// wall on a carpet), and where other surfaces pass through it or end
// just above it (a lamp below a ceiling). Light differs on the two sides of such a line,
// so cells are cut along it and nothing is interpolated across.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"
#include "mesh/surfaces.h"

namespace unshot {

/// A segment in a surface's chart.
struct ContactSegment {
  glm::dvec2 a{0.0}, b{0.0};
};

/// Contact segments of each surface. `edges`: all edges of the scene's polygons, equal ones side by side;
/// `distance` [m]: how near to the plane an edge lies in it, and how far beyond it on both sides what passes
/// through it reaches. `size` [m]: edge of an element as far as it is known; long edges that come nearer than
/// a quarter of it to a large surface's plane count as well.
std::vector<std::vector<ContactSegment>> findContacts(const Mesh& mesh, const std::vector<SurfaceEdge>& edges,
                                                      double distance, double size,
                                                      const CancelToken& cancel = {});

/// Cuts the convex polygons of one cell by the lines of those segments that pass through it, and marks every
/// edge that lies on a segment as outline. `tolerance` [m].
void cutByContacts(std::vector<std::vector<PieceCorner>>& polygons,
                   const std::vector<ContactSegment>& contacts, double tolerance);

}  // namespace unshot
