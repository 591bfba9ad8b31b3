// Which sides of surfaces light can reach: those that are in the same place (mesh/shells.h) as one that
// emits.
//
// A side on which something stands may be inside of it in parts: it is lit if anything around it is.
//
// Where light is in several places, no light goes straight from a surface of one to one of another: these are
// rooms of their own.
#pragma once

#include <span>
#include <vector>

#include "base/cancel.h"
#include "mesh/contacts.h"
#include "mesh/mesh.h"
#include "mesh/surfaces.h"

namespace unshot {

struct Reached {
  std::vector<char>
      sides;            ///< two flags for each of Mesh::surfaces, front and back: whether light can reach it
  bool closed = false;  ///< none of the light can leave the scene
  /// Of each of these sides the number of its room, from 0 on; kNone where light does not reach it, or where
  /// it may be in several. Empty where all that light reaches is one.
  std::vector<std::uint32_t> rooms = {};
};

/// `edges`: all edges of the scene's polygons, equal ones side by side; `emits`: two flags for each surface.
/// All sides, and not closed, where nothing emits, or where it cannot be told.
Reached findReach(const Mesh& mesh, const std::vector<SurfaceEdge>& edges,
                  std::span<const Crossing> crossings, std::span<const char> emits, double weld_distance,
                  const CancelToken& cancel = {});

}  // namespace unshot
