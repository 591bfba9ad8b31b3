// How much each of many emitters matters at some place, found for all of them at once.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace unshot {

/// What each of many emitters may bring to a place, whatever hides it: by the power over the fourth power of
/// the distance, and the cosines at both ends; nothing from behind, or from below the horizon.
class EmitterTable {
 public:
  /// Lengths times `scale` are about 1.
  explicit EmitterTable(double scale) : scale_(scale) {}

  /// `centre` and `radius` [m] of a ball around it; `power` in any unit.
  void add(const glm::dvec3& centre, const glm::dvec3& normal, double radius, double power);
  /// After the last one: up to whole blocks, with some that bring nothing.
  void fill();
  double scale() const { return scale_; }
  /// To a ball about `position`, of radius `spread`, on the side that `normal` points away from: one per
  /// emitter, of which the sum is returned.
  double shares(const glm::dvec3& position, const glm::dvec3& normal, double spread,
                std::vector<float>& out) const;

  static constexpr std::size_t kBlock = 16;

 private:
  double scale_;
  std::vector<float> centre_[3], normal_[3], radius_, power_;
};

}  // namespace unshot
