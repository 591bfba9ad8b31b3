// Which patches face the same air, as far as the mesh itself shows it: around an edge where surfaces meet,
// what lies between one surface and the next in turn is one volume, so the two sides that face it belong
// together. A wall that ends on a floor stands between the two halves of it, since its own edge is there; a
// wall that pierces the floor instead, or ends a little above it, is not seen here. At an edge where a
// surface ends alone its two sides are not joined.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// An edge of a piece, in parts between all points that lie on it.
struct PieceEdge {
  std::uint32_t low, high;        ///< points
  std::uint32_t at_low, at_high;  ///< ring corners there
  std::uint32_t piece, surface;
  bool outline;
  bool forward;  ///< counter-clockwise around the piece it runs from low to high
};

/// Fills mesh.patch_air. `edges`: all, sorted by (low, high); `points`: where they end.
void joinAir(Mesh& mesh, std::span<const PieceEdge> edges, std::span<const glm::dvec3> points,
             const CancelToken& cancel = {});

}  // namespace unshot
