// How light is passed on in a scene, by random walks: an estimate of the spectral radius of R K, and of the
// light that escapes, before anything is solved.
//
// Source: power iteration (walkers carry the light of one bounce to the next), with rays in place of form
// factors. Assumes nothing of the mesh but its sides. Known error: a few percent of the radius, less where
// one reflectance prevails (exact in a closed scene of a single one); walks from a thousand places,
// repeatable.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "base/cancel.h"
#include "mesh/mesh_rays.h"

namespace unshot {

struct LightWalks {
  glm::dvec3 spectral_radius{0.0};  ///< per channel: what light keeps of itself from bounce to bounce, far on
  /// Share of the emitted light that leaves the scene, sooner or later; none where no side emits.
  std::optional<double> escaped;
  std::uint32_t rays = 0, escapes = 0;  ///< sent, and of these those that left the scene

  double largestRadius() const;
  /// Bounces until 1 % is left of what the slowest channel holds; none where the radius is 1 or more.
  std::optional<double> bouncesToOnePercent() const;
};

LightWalks walkLight(const Mesh& mesh, const MeshRays& rays, const CancelToken& cancel = {});

}  // namespace unshot
