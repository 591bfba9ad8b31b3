// A pixel of a picture.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace unshot::testing_support {

/// Of an Image8 or ImageF, in its own unit.
template <class Image>
glm::dvec3 pixel(const Image& image, int x, int y) {
  const std::size_t i = 3 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

}  // namespace unshot::testing_support
