// Triangulation of simple polygons by ear clipping, keeping collinear corners (T-vertices stay corners of
// triangles).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace unshot {

/// Triangles (indices into `outline`, counter-clockwise) of a simple polygon given counter-clockwise.
/// Collinear corners are kept as corners; no triangle of zero area is made as long as the outline is simple.
/// n - 2 triangles for n corners (fewer where the outline is degenerate).
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const glm::dvec2> outline);

}  // namespace unshot
