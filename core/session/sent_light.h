// What a scene sends at some moment of a solve, for looks through it (gather.h).
#pragma once

#include <vector>

#include "session/gather.h"
#include "session/snapshot.h"
#include "solver/state.h"

namespace unshot {

struct SentLight {
  std::vector<glm::dvec3> emission;  ///< one per patch [W/m^2]
  std::vector<glm::dvec3> light;     ///< besides emission, one per element [W/m^2]
  glm::dvec3 sky{0.0};               ///< [W/m^2]
};

/// Emission and sky as the state has them: all, or without what is unshot of them. No light besides.
SentLight sourcesOf(const Mesh& mesh, const RadiosityState& state, bool with_unshot);
/// That and what elements reflect of `irradiance`, with what is unshot of it or without.
SentLight lightOf(const Mesh& mesh, const RadiosityState& state, const MeshField& irradiance,
                  bool with_unshot);
/// H of a look [W/m^2].
glm::dvec3 irradianceOf(const Gather& gather, const SentLight& sent, const Mesh& mesh);
/// Of it what comes straight from emitters and the sky, of a look by rays.
glm::dvec3 straightOf(const Gather& gather, const SentLight& sent);

}  // namespace unshot
