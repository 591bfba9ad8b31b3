// The fields of a snapshot from the state of a solve: irradiance at vertices, the ambient estimate, unshot
// radiosity.
#pragma once

#include "formfactor/transport.h"
#include "session/snapshot.h"
#include "solver/ambient.h"
#include "solver/state.h"

namespace unshot {

/// All of the snapshot but its measures.
Snapshot makeFields(std::shared_ptr<const Mesh> mesh, const Transport& transport, const RadiosityState& state,
                    const AmbientTerm& ambient);

}  // namespace unshot
