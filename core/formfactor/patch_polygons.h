// The outlines of patches, for factors and points on them.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "formfactor/polygon_factor.h"
#include "mesh/mesh.h"

namespace unshot {

class PatchPolygons {
 public:
  /// Keeps nothing of the mesh.
  explicit PatchPolygons(const Mesh& mesh, const CancelToken& cancel = {});

  /// The exact Lambert factor of patch q at a point with this normal (unit length), without occlusion; 0
  /// where point and patch are in one plane, or the patch below the horizon, but for a millionth of the
  /// scene's size. `scratch` spares allocations.
  double factor(std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal,
                std::vector<glm::dvec3>& scratch) const;
  /// The same but for FactorPolygon::quick.
  double quickFactor(std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal,
                     std::vector<glm::dvec3>& scratch) const;
  /// Whether these can be other than 0.
  bool faces(std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal) const {
    return isSeen(patches_[q], q, point, normal);
  }
  /// kNone where it lies on several surfaces.
  std::uint32_t surface(std::uint32_t q) const { return patches_[q].surface; }
  /// Its pieces, or itself where it is a rectangle.
  std::span<const FactorPolygon> parts(std::uint32_t q) const { return patches_[q].parts; }
  /// `n` (a power of two) points of the patch that stand for equal parts of its area, spread so that they
  /// fall into n different places along each side of a rectangle, none of them on its border; for one, its
  /// centre.
  void spread(std::uint32_t q, std::uint32_t n, std::vector<glm::dvec3>& out) const;
  struct Corner {
    glm::dvec3 at;
    glm::dvec3 inside;  ///< a point within the patch, of which all of the way there from the corner is too
  };
  /// The corner farthest along `direction`.
  Corner highest(std::uint32_t q, const glm::dvec3& direction) const;
  /// Middle and radius [m] of a sphere around the patch.
  const glm::dvec3& middle(std::uint32_t q) const { return patches_[q].middle; }
  double radius(std::uint32_t q) const { return patches_[q].radius; }

 private:
  struct Share {
    glm::dvec3 middle{0.0}, vector_area{0.0};  // [m^2] along the normal
  };
  struct Patch {
    std::vector<FactorPolygon> parts;
    glm::dvec3 middle{0.0}, normal{0.0};
    glm::dvec3 centre{0.0};  // of its area, or a point in it
    double radius = 0;
    std::uint32_t surface = 0;
    bool rectangle = false;
    // Of several surfaces:
    std::vector<Share> shares;  // what stands for it from afar
    std::vector<glm::dvec3> corners;
    glm::dvec3 mean_normal{0.0};
    double most_slant = 0;  // sine of the largest angle between that and a part's normal
    bool joined() const { return surface == kNone; }
  };
  using Pieces = std::vector<std::vector<std::uint32_t>>;  // one list for each of Mesh::patch_shapes
  void collect(const Mesh& mesh, std::uint32_t q, const Pieces& pieces);
  void join(Patch& patch) const;
  double joinedFactor(const Patch& patch, std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal,
                      std::vector<glm::dvec3>& scratch) const;
  void enclose(Patch& patch) const;
  bool isSeen(const Patch& patch, std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal) const;

  std::vector<Patch> patches_;
  double margin_ = 0;  // [m]
};

}  // namespace unshot
