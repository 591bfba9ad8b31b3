// What the lights of a scene see of it: samples of the places that their light arrives at first.
//
// Known error: from a few dozen to a few hundred rays a light, repeatable. Where hardly any of them arrives,
// a thousand more are sent before a light is said to see nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh_rays.h"
#include "mesh/parallel_surfaces.h"

namespace unshot {

/// A light: surfaces of one emitting material that hang together. Counts are of rays from its sides that
/// emit.
struct LightView {
  std::vector<std::uint32_t> surfaces;
  std::uint32_t rays = 0;
  std::uint32_t flush = 0;   ///< begin on a place where another surface lies in the light's own plane
  std::uint32_t near = 0;    ///< end within a hundredth of the light's size above it, on another surface
  std::uint32_t own = 0;     ///< end on the light itself
  std::uint32_t lost = 0;    ///< leave the scene
  std::uint32_t fronts = 0;  ///< end on the fronts of other surfaces, further away
  std::uint32_t backs = 0;   ///< end on their backs
  /// What leaves the light, however often reflected, neither leaves the scene nor gets to most of it.
  bool shut_in = false;

  std::uint32_t arrived() const { return fronts + backs; }
};

class LightLooks {
 public:
  /// Keeps references to mesh and token, which must outlive it.
  LightLooks(const Mesh& mesh, bool emit_front_only, const CancelToken& cancel);

  bool empty() const { return lights_.empty(); }
  /// One view per light; of more than some thousand lights only some, spread evenly.
  std::vector<LightView> look(const MeshRays& rays, const ParallelSurfaces& parallels) const;

 private:
  struct Start;
  struct Sampler;

  void groupLights();
  LightView lookAt(const std::vector<std::uint32_t>& surfaces, std::uint32_t count, const MeshRays& rays,
                   const ParallelSurfaces& parallels) const;
  void follow(const Sampler& sampler, const Start& start, const glm::dvec2& direction, const MeshRays& rays,
              const ParallelSurfaces& parallels, LightView& view) const;
  bool seesAnything(const Sampler& sampler, const MeshRays& rays) const;
  bool shutIn(const Sampler& sampler, const MeshRays& rays) const;

  const Mesh& mesh_;
  bool emit_front_only_;
  const CancelToken& cancel_;
  std::vector<std::vector<std::uint32_t>> lights_;
  std::vector<std::uint32_t> light_of_;  ///< one per surface; kNone where it is no light
};

}  // namespace unshot
