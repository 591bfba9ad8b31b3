// A mesh that is fine enough in narrow gaps in front of lamps: under a lamp that hangs a hundredth of a room
// below the ceiling and sends light upwards, light goes to and fro many times, and ends at the lamp's outline
// within the width of the gap.
#pragma once

#include <memory>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// Quarters cells of `base`, a uniform mesh, which are wider than the gap between an emitting side and one
/// that faces it, on both of them, until they are about as wide as it or have become twice as many.
/// The result is a mesh of its own, with patches as fine there, or `base` itself where there is no such gap.
/// Throws Cancelled.
std::shared_ptr<const Mesh> refineInGaps(std::shared_ptr<const Mesh> base, const CancelToken& cancel = {});

}  // namespace unshot
