// Colours that tell patches apart: those that touch have different ones.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// Linear RGB; they differ in lightness as well as in hue, so that neighbours can be told apart with any
/// colour vision (after P. Tol's and M. Okabe's qualitative schemes).
inline constexpr std::array<glm::vec3, 12> kPatchPalette = {{{0.033f, 0.016f, 0.246f},
                                                             {0.246f, 0.604f, 0.855f},
                                                             {0.058f, 0.402f, 0.319f},
                                                             {0.723f, 0.565f, 0.184f},
                                                             {0.246f, 0.016f, 0.091f},
                                                             {0.604f, 0.133f, 0.184f},
                                                             {0.791f, 0.347f, 0.003f},
                                                             {0.402f, 0.058f, 0.319f},
                                                             {0.006f, 0.184f, 0.033f},
                                                             {0.319f, 0.319f, 0.033f},
                                                             {0.003f, 0.168f, 0.445f},
                                                             {0.723f, 0.723f, 0.723f}}};

/// One per patch: in kPatchPalette. Patches that share a display vertex have different ones, unless all are
/// taken around them. The same for the same mesh. Throws Cancelled.
std::vector<std::uint8_t> patchColours(const Mesh& mesh, const CancelToken& cancel = {});

}  // namespace unshot
