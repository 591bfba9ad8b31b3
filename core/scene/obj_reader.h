// Reads Wavefront OBJ with MTL into a Scene (home of tinyobjloader).
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace unshot {

/// Reads the scene. Throws Error (kInput: missing, a directory, empty, binary, no faces, indices out of range; with
/// file:line where there is one). What can be repaired is repaired and said in Scene::diagnostics.
Scene readObj(const std::filesystem::path& path);

}  // namespace unshot
