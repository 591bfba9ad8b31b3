// Surfaces that no light can reach on either side: they have no elements, but stand in the picture, black.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace unshot {

struct UnlitSurfaces {
  std::vector<std::uint32_t> surfaces;  ///< in Mesh::surfaces
  std::vector<glm::vec3> corners;       ///< three a triangle
  std::vector<std::uint32_t> of;        ///< one a corner: in `surfaces`
};

/// A surface that light can reach on one side is none of them: its other side stays open to the eye.
UnlitSurfaces unlitSurfaces(const Mesh& mesh);

}  // namespace unshot
