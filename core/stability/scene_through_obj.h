// A generated scene on the way that a user's takes: written as OBJ and MTL and read again.
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace unshot {

/// Writes scene.obj and scene.mtl into `folder`, with all digits; returns the former's path. Throws Error
/// (kEnvironment) where it cannot.
std::filesystem::path writeObj(const Scene& scene, const std::filesystem::path& folder);

/// The same polygons and materials, as the reader makes them; what it says is in Scene::diagnostics. The
/// files lie in a folder of their own among the system's temporary ones, and are gone afterwards. Throws
/// Error (kEnvironment) where none can be made.
Scene throughObj(const Scene& scene);

}  // namespace unshot
