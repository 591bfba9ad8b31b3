// What lies parallel to a surface, close above or below a point of it: in double precision, so that gaps are
// found that rays would not tell from contact.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/box_tree.h"
#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

class ParallelSurfaces {
 public:
  struct Found {
    std::uint32_t surface = 0;
    double height = 0;      ///< above the point, along the normal of the surface that is asked about [m]
    bool same_way = false;  ///< both fronts point the same way
  };

  /// Keeps a reference to the mesh, which must outlive it.
  explicit ParallelSurfaces(const Mesh& mesh, const CancelToken& cancel = {});

  /// Every other surface that is parallel to `surface` within some two degrees and covers the point on it, at
  /// most `distance` [m] off, on whichever side. Any thread.
  std::vector<Found> around(const glm::dvec3& point, std::uint32_t surface, double distance) const;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> surface_of_;
  BoxTree tree_;
};

}  // namespace unshot
