// Light straight from emitters at any point: the Lambert factor of each emitting patch times the share of it
// that shadow rays find visible.
#pragma once

#include <memory>
#include <vector>

#include "formfactor/pointwise.h"

namespace unshot {

class DirectLight {
 public:
  /// The mesh must outlive it. `occlusion`: whether anything can stand between two points.
  DirectLight(const Mesh& mesh, bool occlusion, std::uint64_t seed);

  /// H_d [W/m^2] at a point of a side, off its edges. Of emitters that bring no more than `negligible`
  /// [W/m^2], channels summed, nothing is taken to be hidden.
  glm::dvec3 at(const glm::dvec3& position, std::uint32_t side, double negligible);
  /// How many patches each point looks at.
  std::size_t emitterCount() const { return emitters_.size(); }

 private:
  const Mesh& mesh_;
  std::shared_ptr<const PatchPolygons> polygons_;
  std::unique_ptr<Visibility> visibility_;
  std::vector<std::uint32_t> emitters_;  // patches
  std::vector<glm::dvec3> scratch_;
};

}  // namespace unshot
