// Irradiance at a point by path tracing over diffuse surfaces, without bias: what a radiosity solution of
// infinite fineness would be.
//
// From the point a path goes on by cosine-distributed directions; at each of its vertices an emitter is
// sampled too (next-event estimation), and both are weighted by the power heuristic of multiple importance
// sampling (E. Veach, "Robust Monte Carlo methods for light transport simulation", 1997, section 9.2), so
// that emitters that touch a receiver, lie in its plane or are hard to hit do no harm. What leaves the scene
// meets the sky. Russian roulette ends a path. Directions and emitters at the first vertices are stratified
// over a batch of paths (jittered grids); batches are independent of each other. Assumes two-sided diffuse
// surfaces. Error: random alone, but for surfaces nearer to each other than twice SceneRays::lift, and for
// rays that meet a wall in its very edge and pass it (3e-7 of them in a room of 1 m).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "rays/scene_rays.h"
#include "scene/scene.h"
#include "scene/scene_triangles.h"

namespace unshot {

/// Paths of a batch.
inline constexpr std::uint32_t kPathsPerBatch = 16;

class PathTracer {
 public:
  /// Copies what it needs of the scene. `sky`: its radiosity [W/m^2]. Throws Error (kInput) where neither it
  /// nor anything in the scene emits.
  PathTracer(const Scene& scene, bool emit_front_only, const glm::dvec3& sky);

  /// Mean over a batch of paths of the irradiance H [W/m^2] at `point` (scene's frame) on the side that
  /// `normal` (unit length) points away from. The same for the same arguments. Any thread.
  glm::dvec3 irradiance(const glm::dvec3& point, const glm::dvec3& normal, std::uint64_t stream,
                        std::uint64_t batch) const;

  /// Whether a random path of at most so many bounces from there leaves the scene. Any thread.
  bool findsWayOut(glm::dvec3 point, glm::dvec3 normal, int bounces) const;

  // Triangles of the scene, as in `rays()`.
  const SceneRays& rays() const { return rays_; }
  std::uint32_t polygonOf(std::uint32_t triangle) const { return triangles_.polygon[triangle]; }
  const glm::dvec3& reflectance(std::uint32_t triangle) const;
  /// E [W/m^2] of a side of a triangle; 0 for a back where only fronts emit.
  glm::dvec3 emission(std::uint32_t triangle, bool back) const;

 private:
  struct Draws;
  glm::dvec3 path(glm::dvec3 point, glm::dvec3 normal, Draws& draws) const;
  glm::dvec3 sampleEmitter(const glm::dvec3& point, const glm::dvec3& normal, double u, double v) const;

  SceneTriangles triangles_;
  SceneRays rays_;
  std::vector<Material> materials_;
  std::vector<std::uint32_t> material_of_;  // one per triangle
  bool emit_front_only_ = false;
  glm::dvec3 sky_{0.0};
  std::vector<std::uint32_t> emitters_;   // triangles
  std::vector<double> cumulative_power_;  // one per emitter, of the sum; the last is 1
  std::vector<double> density_;  // one per triangle: of a sampled emitter's points, over area [1/m^2]
};

}  // namespace unshot
