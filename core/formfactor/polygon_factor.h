// The share of a point's diffuse view that a polygon fills (Lambert 1760; as a sum over edges in Baum,
// Rushmeier and Winget 1989): F = 1 / (2 pi) sum theta_k n . Gamma_k.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace unshot {

/// Exact but for rounding. `corners` of a planar polygon, counter-clockwise as seen from the point's side of
/// its plane (the other way round gives 0 or less); what lies below the point's horizon is clipped away.
/// `scratch` spares allocations.
double pointToPolygonFactor(const glm::dvec3& point, const glm::dvec3& normal,
                            std::span<const glm::dvec3> corners, std::vector<glm::dvec3>& scratch);

}  // namespace unshot
