// What a solve leaves out because this scene does not need it (law 7), decided in one place.
#pragma once

#include <vector>

#include "mesh/mesh.h"
#include "session/solve.h"

namespace unshot {

/// The decisions that hold for the scene and its mesh with this form-factor method.
std::vector<PlanDecision> makePlan(const Scene& scene, const Mesh& mesh, const std::string& form_factors);

}  // namespace unshot
