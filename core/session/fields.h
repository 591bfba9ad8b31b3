// The fields of a snapshot from the state of a solve: irradiance and its direct part, the ambient estimate,
// unshot radiosity.
#pragma once

#include "formfactor/transport.h"
#include "session/snapshot.h"
#include "solver/ambient.h"
#include "solver/state.h"

namespace unshot {

/// A field on receivers (one value each) at the vertices and on the elements: where one of the two is not
/// what the receivers are, interpolated or averaged.
MeshField makeField(const Mesh& mesh, const Receivers& receivers, const std::vector<glm::dvec3>& values);

/// Values of patches (one each) at the vertices, interpolated.
std::vector<glm::vec3> fieldOfPatches(const Mesh& mesh, const std::vector<glm::dvec3>& values);

/// All of the snapshot but its measures, direct light, bounces and residual.
Snapshot makeFields(std::shared_ptr<const Mesh> mesh, const Transport& transport, const RadiosityState& state,
                    const AmbientTerm& ambient);

}  // namespace unshot
