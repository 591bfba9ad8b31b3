// Reads Wavefront OBJ with MTL into a Scene (home of tinyobjloader).
#pragma once

#include <filesystem>

#include "base/cancel.h"
#include "scene/scene.h"

namespace unshot {

/// Reads the scene. Throws Error (kInput: missing, a directory, empty, binary, no faces, indices out of
/// range; with file:line where there is one). What can be repaired is repaired and said in
/// Scene::diagnostics, once for each kind with its count and first place. Codes of warnings: degenerate-face,
/// self-intersecting-face, duplicate-face, duplicate-face-material, unusable-normal, no-material,
/// unknown-material, missing-mtl, unreadable-mtl, reflectance-clamped, emission-clamped, unreadable-colour,
/// unreadable-texture, free-form, unknown-statement, no-light; of notes: repeated-corner, non-planar-face,
/// lines-and-points, repeated-material, no-kd, read-past. Scene::materials holds what a usemtl names, in the
/// order of their first use. Any thread may call it. Throws Cancelled where `cancel` asks for it.
Scene readObj(const std::filesystem::path& path, const CancelToken& cancel = {});

}  // namespace unshot
