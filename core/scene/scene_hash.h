// Tells scenes apart by what they hold, wherever they lie.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace unshot {

/// The same for scenes of the same geometry and materials, in the same order; 64 bits of XXH3. Of a scene
/// whose materials have been edited that of the scene as it was read.
std::uint64_t sceneHash(const Scene& scene);

}  // namespace unshot
