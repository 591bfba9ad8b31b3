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
  struct Patch {
    std::vector<FactorPolygon> parts;
    glm::dvec3 middle{0.0}, normal{0.0};
    glm::dvec3 centre{0.0};  // of its area, or a point in it
    double radius = 0;
    std::uint32_t surface = 0;
    bool rectangle = false;
  };
  void collect(const Mesh& mesh, std::uint32_t q, std::span<const std::uint32_t> pieces);
  void enclose(Patch& patch) const;
  bool isSeen(const Patch& patch, std::uint32_t q, const glm::dvec3& point, const glm::dvec3& normal) const;

  std::vector<Patch> patches_;
  double margin_ = 0;  // [m]
};

}  // namespace unshot
