// Irradiance at a point by rays through the true geometry, kept as weights on patches and elements, so that
// it can be worked out for every state of a solve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh_rays.h"
#include "session/emitter_table.h"

namespace unshot {

/// In place of an element: a ray that leaves the scene, into the sky.
inline constexpr std::uint32_t kToSky = kNone - 1;

/// One unbiased look from a point. H = sum of weight * (what the patch sends of its emission) over `lights`
/// + mean of what the elements in `rays` send besides + sum of weight * (all that the element sends) over
/// `shares` + `sky` of what the sky sends.
struct Gather {
  struct Light {
    std::uint32_t patch;
    float weight;
  };
  std::vector<Light> lights;
  std::vector<std::uint32_t> rays;  ///< elements met; kToSky; kNone where a ray meets an unlit side
  struct Share {
    std::uint32_t element;
    float weight;
  };
  std::vector<Share> shares;  ///< of an exact look (exact_look.h), which has neither lights nor rays
  float sky = 0;              ///< of an exact look
};

/// How many rays a look takes.
struct LookSize {
  int strata = 12;  ///< of rays, along each side of their grid
  /// Of more emitting triangles so many are drawn at random, besides those that matter most; else all are
  /// taken. 0: none is looked at.
  std::size_t emitters = 16;
  /// What hides emitters that are wider than they are away is told by the rays, without bias, else as for
  /// others by points of them, with less noise.
  bool without_bias = true;
};

/// Looks around in a scene. Emitters are seen by their exact polygon factor times the share of it that shadow
/// rays find visible, all else by cosine-distributed rays in strata; where an emitter is very wide these tell
/// how much of it is hidden.
class Gatherer {
 public:
  explicit Gatherer(const Mesh& mesh);

  /// From `position` on the side that `normal` points away from; `stream` numbers independent looks.
  Gather look(const glm::dvec3& position, const glm::dvec3& normal, std::uint64_t stream,
              const LookSize& size = {}) const {
    return lookFromAll({&position, 1}, normal, stream, size);
  }
  /// One look for the mean over points of a surface, at least one: its rays begin at all of them in turn.
  Gather lookFromAll(std::span<const glm::dvec3> positions, const glm::dvec3& normal, std::uint64_t stream,
                     const LookSize& size) const;

 private:
  struct Emitter {
    std::uint32_t triangle;  // in Mesh::triangles
    std::uint32_t side;
  };
  struct Reach {
    glm::dvec3 direction;  // of a ray
    double distance;       // where it ends [m]
  };
  void lookAtLights(std::span<const glm::dvec3> positions, const glm::dvec3& normal,
                    const std::vector<Reach>& reaches, std::uint64_t stream, std::size_t most,
                    Gather& out) const;
  void lookAtLight(const Emitter& emitter, const glm::dvec3& position, const glm::dvec3& normal,
                   const std::vector<Reach>& reaches, int samples, double weight, std::uint64_t stream,
                   Gather& out) const;
  void takeHidden(const Emitter& emitter, const glm::dvec3& position, const std::vector<Reach>& reaches,
                  double weight, Gather& out) const;
  std::uint32_t elementOf(std::uint32_t surface, std::uint32_t side, const glm::dvec3& position) const;

  const Mesh& mesh_;
  MeshRays rays_;
  std::vector<Emitter> emitters_;
  EmitterTable table_;  // of them
};

}  // namespace unshot
