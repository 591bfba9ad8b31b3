// Picking: what the eye meets along a ray, and what the plan decided for it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "session/scene_plan.h"

namespace unshot {

/// A point of a surface, on the side that is seen.
struct Pick {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  ///< unit length, towards the eye
  std::uint32_t surface = 0;
  bool back = false;
  std::uint32_t side = kNone;                    ///< in Mesh::sides; kNone where no light can reach it
  std::uint32_t element = kNone, patch = kNone;  ///< kNone without a side
};

/// The first surface along the ray (`direction` of unit length) as pictures show it: a side that no light can
/// reach is looked through where light reaches the other one, and is black where none does. Looks at every
/// triangle of the scene, so that nothing need be built (some 10 ns each).
std::optional<Pick> pickAlong(const Mesh& mesh, const glm::dvec3& origin, const glm::dvec3& direction);

/// The edges around all display triangles of the patch, each from its first to its second end.
std::vector<std::pair<glm::vec3, glm::vec3>> patchOutline(const Mesh& mesh, std::uint32_t patch);

/// Elements of the patch.
std::vector<std::uint32_t> elementsOf(const Mesh& mesh, std::uint32_t patch);

/// Something that the plan decided for the side that was picked, or for all of the scene with it.
struct PickedDecision {
  std::string_view key;  ///< of planRows()
  std::string text;      ///< a sentence
};

/// `plan`: of the solve that the mesh is of. In the order of the plan's table, but the picked side before the
/// other; nothing where it left out nothing here.
std::vector<PickedDecision> decisionsFor(const Mesh& mesh, const Pick& pick,
                                         const std::vector<PlanDecision>& plan);

}  // namespace unshot
