// The rows of the table of cases, by kind. One call adds what belongs together.
#pragma once

#include <array>
#include <vector>

#include "base/text.h"
#include "stability/lit_cube_truth.h"
#include "stability/stability_cases.h"

namespace unshot {

using Cases = std::vector<StabilityCase>;

// lit_cube_rows.cpp
void addFurnaces(Cases& cases);
void addChannels(Cases& cases);
void addEmissions(Cases& cases);
// manufactured_rows.cpp
void addManufactured(Cases& cases);
void addPlaces(Cases& cases);
// far_and_near_rows.cpp
void addFarAndNear(Cases& cases);
void addEnds(Cases& cases);

/// So many elements, all alike; the solver's error.
SolveOptions evenMesh(std::uint64_t elements, double error);
/// The lit face, the opposite one and the others of a lit cube, each channel against the truth of its own
/// reflectance times `emission`.
std::vector<Figure> litCubeFigures(const Solve& solve, const std::array<const LitCubeTruth*, 3>& truth,
                                   const glm::dvec3& emission, double tolerance);

}  // namespace unshot
