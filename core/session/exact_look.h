// Irradiance at a point of a scene in which nothing can occlude, from the Lambert factor of every
// element, exact or from far away to some 1e-4 of it (FactorPolygon::quick): what the rays of a Gatherer
// would find, without their noise.
#pragma once

#include <vector>

#include "formfactor/polygon_factor.h"
#include "mesh/mesh.h"
#include "session/gather.h"

namespace unshot {

/// Whether such looks take no longer than those by rays.
bool looksExactlySooner(const Mesh& mesh);

class ExactLook {
 public:
  /// The mesh must outlive it. Nothing in it may stand between two points (nothingCanOcclude).
  explicit ExactLook(const Mesh& mesh);

  /// From `position` on a surface, on the side that `normal` points away from, which is in this room.
  Gather at(const glm::dvec3& position, const glm::dvec3& normal, std::uint32_t room) const;

 private:
  struct Tile {
    FactorPolygon polygon;
    glm::dvec3 normal;
    std::uint32_t element, room;
  };
  double margin_;  // [m]
  std::vector<Tile> tiles_;
};

}  // namespace unshot
