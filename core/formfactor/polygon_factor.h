// The share of a point's diffuse view that a polygon fills (Lambert 1760; as a sum over edges in Baum,
// Rushmeier and Winget 1989): F = 1 / (2 pi) sum theta_k n . Gamma_k.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace unshot {

/// Exact but for rounding. `corners` of a planar polygon, counter-clockwise as seen from the point's side of
/// its plane (the other way round gives 0 or less); what lies below the point's horizon is clipped away.
/// `scratch` spares allocations.
double pointToPolygonFactor(const glm::dvec3& point, const glm::dvec3& normal,
                            std::span<const glm::dvec3> corners, std::vector<glm::dvec3>& scratch);

/// A planar polygon made ready to be looked at from many points.
class FactorPolygon {
 public:
  /// Counter-clockwise as seen from the side that faces the points.
  explicit FactorPolygon(std::vector<glm::dvec3> corners);

  const std::vector<glm::dvec3>& corners() const { return corners_; }
  const glm::dvec3& centre() const { return centre_; }  ///< the mean of its corners
  const glm::dvec3& normal() const { return normal_; }  ///< unit length
  double area() const { return area_; }                 ///< [m^2]
  double radius() const { return radius_; }             ///< of a sphere around the centre [m]
  bool isParallelogram() const { return parallelogram_; }

  /// pointToPolygonFactor.
  double exact(const glm::dvec3& point, const glm::dvec3& normal, std::vector<glm::dvec3>& scratch) const {
    return pointToPolygonFactor(point, normal, corners_, scratch);
  }
  /// The same, but 0 from behind, within 0.3 % and a good deal sooner: from farther away than four radii, and
  /// wholly above the horizon, as a sum over a few points of the polygon (Gauss's rule on a parallelogram,
  /// Hammer and Stroud's on a triangle).
  double quick(const glm::dvec3& point, const glm::dvec3& normal, std::vector<glm::dvec3>& scratch) const;
  /// As quick, for one of many polygons: from farther away than four radii each point of it is above the
  /// horizon or below with all that it stands for.
  double rough(const glm::dvec3& point, const glm::dvec3& normal, std::vector<glm::dvec3>& scratch) const;

 private:
  struct Sample {
    glm::dvec3 at;
    double area;
  };
  double sampled(const glm::dvec3& point, const glm::dvec3& normal) const;
  void addTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

  std::vector<glm::dvec3> corners_;
  glm::dvec3 centre_{0.0}, normal_{0.0};
  double area_ = 0, radius_ = 0;
  bool parallelogram_ = false;
  std::vector<Sample> samples_;
};

}  // namespace unshot
