// Surfaces: connected coplanar polygons of one material, each with a chart; and which surfaces meet smoothly.
#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "mesh/weld.h"
#include "scene/scene.h"

namespace unshot {

/// An edge of a polygon of the scene and the surface it belongs to; an edge of n polygons stands n times.
struct SurfaceEdge {
  std::uint32_t a = 0, b = 0;  ///< in Mesh::positions
  std::uint32_t surface = 0;
  bool forward = false;  ///< counter-clockwise about the surface's normal the polygon runs from a to b
};

struct SurfaceTopology {
  std::vector<SmoothPair> smooth_pairs;
  std::vector<SurfaceEdge> edges;
};

/// Fills mesh.surfaces (material, chart, area, triangles), mesh.triangles and mesh.positions.
/// Polygons are joined only across edges that exactly two polygons share: where a third stands on the edge (a
/// wall on a floor), light on one side is not light on the other. Not at all where not to `join`.
SurfaceTopology makeSurfaces(const Scene& scene, const WeldedScene& welded, bool join, Mesh& mesh,
                             const CancelToken& cancel = {});

}  // namespace unshot
