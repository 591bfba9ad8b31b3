// Patches that are whole rectangles of one or two by one or two cells: over them a field known at the corners
// of the cells is taken to be the product of lines (one cell) or parabolas (two) along both sides, whose mean
// and whose values in between are nearer to a smooth field than those of the flat triangles between the
// corners.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

struct PatchLattice {
  std::uint32_t nu = 1, nv = 1;           ///< cells along u and v: 1 or 2
  glm::dvec2 low{0.0}, high{0.0};         ///< rectangle in the chart
  std::array<std::uint32_t, 9> vertex{};  ///< that of corner (i, j) is [j (nu + 1) + i]

  std::uint32_t size() const { return (nu + 1) * (nv + 1); }
  /// Weights of the corners in the field's mean (Simpson's rule along two cells); they are above 0.
  std::array<double, 9> meanWeights() const;
  /// Weights of the corners at a point of the rectangle; they sum to 1, and some may be below 0.
  std::array<double, 9> weightsAt(const glm::dvec2& uv) const;
};

/// One per patch; none where it is no such rectangle.
std::vector<std::optional<PatchLattice>> patchLattices(const Mesh& mesh, const CancelToken& cancel = {});

}  // namespace unshot
