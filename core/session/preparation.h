// What stands before the first shot and needs no OpenGL: the mesh, the method, checks and plan.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/mesh_rays.h"
#include "session/coarse_mesh.h"
#include "session/scene_plan.h"
#include "session/solve.h"

namespace unshot {

struct Preparation {
  std::shared_ptr<const Mesh> mesh;
  std::string form_factors;  ///< key of the method: what `auto` became
  glm::dvec3 sky{0.0};       ///< its radiosity [W/m^2]: what was asked for, or what skyOver makes of it
  std::vector<PlanDecision> plan;
  bool gathers = false;                       ///< whether final gathering is to follow (final_gather.h)
  std::optional<SolvedAtOnce> solved;         ///< the mesh's light, where trying it has brought that
  Diagnostics diagnostics;                    ///< of scene, mesh, checks and choice of method
  std::shared_ptr<const MeshRays> rays;       ///< of the mesh, where a check has asked for them; else null
  double mesh_seconds = 0, plan_seconds = 0;  ///< wall time
};

/// Meshes the scene and plans its solve. Any thread. Throws Error (kUsage for an unknown form-factor method
/// or an impossible mesh), Cancelled.
Preparation prepare(const Scene& scene, const SolveOptions& options, const CancelToken& cancel = {});

}  // namespace unshot
