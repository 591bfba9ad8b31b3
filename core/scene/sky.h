// The sky: uniform light from wherever no surface hides it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "scene/scene.h"

namespace unshot {

/// Whether some face emits light.
bool emitsLight(const Scene& scene);

/// Radiosity of a sky [W/m^2] from "r,g,b"; nothing where these are not three finite numbers from 0 on.
std::optional<glm::dvec3> parseSky(std::string_view text);

/// Radiosity of the sky [W/m^2], which is what a surface in the open receives of it: as asked for or, where
/// nothing of the scene emits, 1, so that it does not open in the dark; else none.
glm::dvec3 skyOver(const Scene& scene, const std::optional<glm::dvec3>& asked);

}  // namespace unshot
