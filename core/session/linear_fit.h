// The values at the vertices for which what is interpolated between them is nearest to the light.
//
// Interpolation between exact values leaves a rounded field too low in the middle of every triangle and a
// hollow one too high: h^2 f'' / 8 at most, all of one sign. The best fit in the mean square (Ciarlet 1978,
// the L2 projection onto linear elements) cuts through the field: its RMS is 2.4 times smaller. How the field
// bends is read from its own gradients, recovered at the vertices (Zienkiewicz and Zhu 1992).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "mesh/mesh.h"

namespace unshot {

/// `values`: of a field, exact at mesh.vertices, one each. Nothing passes from one surface to another where
/// they share no vertices. Only what is above 0 changes, and stays above or at 0; a field that is linear on
/// the triangles around a vertex keeps its value there.
std::vector<glm::dvec3> fitBetween(const Mesh& mesh, std::vector<glm::dvec3> values);

}  // namespace unshot
