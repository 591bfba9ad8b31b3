// Rays against the surfaces of a mesh, independent of its fineness.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "rays/scene_rays.h"

namespace unshot {

/// SceneRays of what light reaches: their triangles are litTriangles(), numbered as Mesh::triangles, so a
/// hit's `back` is the back of its surface.
class MeshRays {
 public:
  struct Hit {
    SceneRays::Hit at;
    std::uint32_t surface = 0;
    std::uint32_t side = kNone;  ///< in Mesh::sides; kNone where the mesh has it that no light reaches it
  };

  /// Keeps a reference to the mesh, which must outlive it.
  explicit MeshRays(const Mesh& mesh);

  /// The first surface along the ray (`direction` of unit length). Any thread.
  std::optional<Hit> intersect(const glm::dvec3& origin, const glm::dvec3& direction) const;
  /// As SceneRays::occluded(), of segments between lifted() points of lit sides: against those surfaces alone
  /// that can stand between two points (Surface::between). Any thread.
  std::uint32_t occluded(const glm::dvec3& a, std::span<const glm::dvec3> b) const {
    return between_ ? between_->occluded(a, b) : rays_.occluded(a, b);
  }
  /// For lifted() and points on triangles.
  const SceneRays& rays() const { return rays_; }
  /// Surface of each of litTriangles().
  std::uint32_t surfaceOf(std::uint32_t triangle) const { return surface_of_[triangle]; }

 private:
  const Mesh& mesh_;
  SceneRays rays_;
  std::optional<SceneRays> between_;  // none where it would be all of them
  std::vector<std::uint32_t> surface_of_;
};

}  // namespace unshot
