// Contacts: where edges of other surfaces lie in a surface's plane, inside its outline (a block on a floor, a
// wall on a carpet), and where other surfaces pass through it or end
// just above it (a lamp below a ceiling). Light differs on the two sides of such a line,
// so cells are cut along it and nothing is interpolated across.
#pragma once

#include <span>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"
#include "mesh/surfaces.h"

namespace unshot {

/// A segment in a surface's chart.
struct ContactSegment {
  glm::dvec2 a{0.0}, b{0.0};
};

/// Where a surface passes through another one's plane, inside its outline.
struct Crossing {
  std::uint32_t surface = 0, by = 0;
  ContactSegment line;      ///< in the chart of `surface`
  bool at_outline = false;  ///< of `surface`, which only ends there
};

/// `distance` [m]: how far beyond the plane on both sides what passes through it reaches.
std::vector<Crossing> findCrossings(const Mesh& mesh, double distance, const CancelToken& cancel = {});

/// An edge of other surfaces' polygons in a surface's plane and inside the rectangle of its outline.
struct Touch {
  std::uint32_t surface = 0;
  std::uint32_t edge = 0;  ///< the first of its uses among all edges
  ContactSegment line;     ///< in the chart of `surface`
};

/// `edges`: all edges of the scene's polygons, equal ones side by side; `distance` [m]: how near to the plane
/// an edge lies in it.
std::vector<Touch> findTouches(const Mesh& mesh, const std::vector<SurfaceEdge>& edges, double distance,
                               const CancelToken& cancel = {});

using Contacts = std::vector<std::vector<ContactSegment>>;  // of each surface

/// Contact segments of each lit surface with lit ones, `crossings` among them. `size` [m]: edge of an element
/// as far as it is known; long edges that come nearer than a quarter of it to a large surface's plane count
/// as well.
Contacts findContacts(const Mesh& mesh, const std::vector<SurfaceEdge>& edges,
                      std::span<const Crossing> crossings, double distance, double size,
                      const CancelToken& cancel = {});

/// Cuts the convex polygons of one cell by the lines of those segments that pass through it, and marks every
/// edge that lies on a segment as outline. `tolerance` [m].
void cutByContacts(std::vector<std::vector<PieceCorner>>& polygons,
                   const std::vector<ContactSegment>& contacts, double tolerance);

}  // namespace unshot
