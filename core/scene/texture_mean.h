// The mean colour of an image file (home of stb_image).
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>

namespace unshot {

/// Mean linear RGB over the pixels of the image; nothing where it cannot be read. Any format that stb_image
/// knows.
std::optional<glm::dvec3> textureMean(const std::filesystem::path& path);

}  // namespace unshot
