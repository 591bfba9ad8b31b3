// (I - M)^-1 among patches, to a few digits: what carries a residual to the error that it causes.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "solver/patch_matrix.h"

namespace unshot {

/// x of (I - M) x = b with M = rho P over the known columns of `matrix`, per channel, by minimal residuals
/// until the residual is `tolerance` of b (in the area-weighted RMS) or `most` products are used. `b` and
/// `reflectance` one per patch.
std::vector<glm::dvec3> solvePatches(const PatchMatrix& matrix, const std::vector<glm::dvec3>& reflectance,
                                     const std::vector<glm::dvec3>& b, double tolerance, int most);

}  // namespace unshot
