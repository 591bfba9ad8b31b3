// How light changes along elements, for receivers so near that it is not the mean of an element that they
// see: beside an edge of a room half of what a point receives comes from within its own distance of the edge,
// where the other wall may be far darker than its element is in the mean.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "formfactor/receivers.h"
#include "mesh/mesh.h"

namespace unshot {

class ElementSlopes {
 public:
  /// None: light is even on every element.
  ElementSlopes() = default;
  /// `light`: B - E at mesh.vertices, one each [W/m^2]. An element's is linear, with the mean gradient over
  /// its display triangles.
  ElementSlopes(const Mesh& mesh, std::span<const glm::dvec3> light);

  /// Of a convex polygon of element e: the sum, over parts of it, of what the view has of them, as Lambert
  /// factors, times how far their middles are from that of the element [m]. `factor`: of all of it; `ring`:
  /// its corners, counter-clockwise as seen from the view. Parts whose light differs by so little that it
  /// brings less than kNegligible of the scene's mean light are not taken apart further.
  glm::dvec3 moment(const ReceiverView& view, std::uint32_t e, std::span<const glm::dvec3> ring,
                    double factor, std::vector<glm::dvec3>& scratch) const;
  /// What a view with this moment of element e has of it beyond its factor times the element's mean light
  /// [W/m^2].
  glm::dvec3 excess(std::uint32_t e, const glm::dvec3& moment) const;

  static constexpr double kNegligible = 0.003;

 private:
  struct Slope {
    glm::dvec3 centre{0.0};       // where the light is the element's mean
    glm::dvec3 gradient[3] = {};  // one a channel [W/m^2 per m]
    double steepest = 0;          // the longest of them
  };
  glm::dvec3 moment(const ReceiverView& view, const Slope& slope, std::span<const glm::dvec3> ring,
                    double factor, int halvings, std::vector<glm::dvec3>& scratch) const;

  std::vector<Slope> slopes_;  // one per element, or none
  double negligible_ = 0;      // [W/m^2]
};

}  // namespace unshot
