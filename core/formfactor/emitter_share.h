// Which parts of the scene emit so much that everything sees the edges of their shadows.
#pragma once

#include "mesh/mesh.h"

namespace unshot {

class EmitterShare {
 public:
  explicit EmitterShare(const Mesh& mesh) {
    for (std::uint32_t q = 0; q < mesh.patch_count; ++q)
      emitted_ += mesh.patch_area[q] * mesh.sides[mesh.patch_side[q]].emission;
  }

  /// Whether `area` [m^2] of the side emits more than 1/64 of what the scene emits, in some channel: there
  /// are at most a few hundred such parts, whatever the scene.
  bool isLarge(const Side& side, double area) const {
    for (int c = 0; c < 3; ++c) {
      if (area * side.emission[c] > kShare * emitted_[c]) return true;
    }
    return false;
  }

 private:
  static constexpr double kShare = 1.0 / 64;

  glm::dvec3 emitted_{0.0};  // power of all patches, per channel [W]
};

}  // namespace unshot
