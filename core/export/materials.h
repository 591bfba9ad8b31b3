// Materials as an MTL file.
#pragma once

#include <filesystem>
#include <span>

#include "scene/scene.h"

namespace unshot {

/// Kd and Ke of each material that has a name, in full precision: a scene that uses the file in the place of
/// its own is solved alike. Textures are in their means. Throws Error (kEnvironment).
void writeMaterials(const std::filesystem::path& path, std::span<const Material> materials);

}  // namespace unshot
