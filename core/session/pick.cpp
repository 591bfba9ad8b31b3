#include "session/pick.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "base/text.h"
#include "mesh/grid.h"

namespace unshot {
namespace {

// Rays through an edge meet one of its triangles at least: barycentric weights may be below 0 by rounding.
constexpr double kEdge = -1e-12;

// The distance to the triangle abc along the ray (Moeller and Trumbore 1997), infinite where it misses.
double distanceTo(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& origin,
                  const glm::dvec3& direction) {
  constexpr double kMissed = std::numeric_limits<double>::infinity();
  const glm::dvec3 ab = b - a, ac = c - a, across = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0) return kMissed;
  const glm::dvec3 from = origin - a;
  const double u = glm::dot(from, across) / determinant;
  if (!(u >= kEdge)) return kMissed;
  const glm::dvec3 around = glm::cross(from, ab);
  const double v = glm::dot(direction, around) / determinant;
  if (!(v >= kEdge && u + v <= 1 - kEdge)) return kMissed;
  const double distance = glm::dot(ac, around) / determinant;
  return distance > 0 ? distance : kMissed;
}

// Null where it was not taken.
const PlanDecision* decisionOf(const std::vector<PlanDecision>& plan, std::string_view key) {
  const auto found =
      std::find_if(plan.begin(), plan.end(), [&](const PlanDecision& d) { return d.key == key; });
  return found == plan.end() ? nullptr : &*found;
}

std::string evenLightText(const Mesh& mesh, std::uint32_t element) {
  const std::uint32_t whole = mesh.element_from_base[element];
  const auto parts = std::count(mesh.element_from_base.begin(), mesh.element_from_base.end(), whole);
  if (parts == 1) return "A coarse element: direct light is even here, so it is not cut further.";
  return "A fine element, one of " + countText(static_cast<std::uint64_t>(parts)) +
         " that a coarse one was cut into: direct light changes here.";
}

std::string idleText(const Mesh& mesh, std::uint32_t patch) {
  const bool black = mesh.sides[mesh.patch_side[patch]].reflectance == glm::dvec3(0.0) && !mesh.emits(patch);
  return black ? "Its patch never shot: it is black."
               : "Its patch never shot: the error asked for was reached before its light mattered.";
}

std::vector<PickedDecision> decisionsForSides(const Surface& surface, bool picked_back) {
  std::vector<PickedDecision> out;
  for (const bool back : {picked_back, !picked_back}) {
    if (surface.side[back] != kNone) continue;
    const std::string what = back == picked_back ? "No elements: " : "No elements on its other side: ";
    if (surface.outer[back]) {
      out.push_back({plan_keys::kOuterSides, what + "nothing of the scene lies in front of it."});
    } else {
      out.push_back({plan_keys::kDarkSides, what + "closed surfaces keep it from every light."});
    }
  }
  return out;
}

}  // namespace

std::optional<Pick> pickAlong(const Mesh& mesh, const glm::dvec3& origin, const glm::dvec3& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  Pick pick;
  for (std::uint32_t s = 0; s < mesh.surfaces.size(); ++s) {
    const Surface& surface = mesh.surfaces[s];
    const bool back = glm::dot(surface.normal, direction) > 0;
    if (surface.side[back] == kNone && surface.side[!back] != kNone) continue;
    for (std::uint32_t t = surface.triangles.first; t < surface.triangles.end(); ++t) {
      const std::uint32_t* corner = mesh.triangles[t].position;
      const double distance = distanceTo(mesh.positions[corner[0]], mesh.positions[corner[1]],
                                         mesh.positions[corner[2]], origin, direction);
      if (!(distance < nearest)) continue;
      nearest = distance;
      pick.surface = s;
      pick.back = back;
    }
  }
  if (nearest == std::numeric_limits<double>::infinity()) return std::nullopt;
  const Surface& surface = mesh.surfaces[pick.surface];
  pick.position = origin + nearest * direction;
  pick.normal = pick.back ? -surface.normal : surface.normal;
  pick.side = surface.side[pick.back];
  if (pick.side == kNone) return pick;
  const std::uint32_t local = elementAt(mesh, surface, surface.chart(pick.position));
  if (local == kNone) return pick;
  pick.element = mesh.sides[pick.side].first_element + local;
  pick.patch = mesh.element_patch[pick.element];
  return pick;
}

std::vector<std::uint32_t> elementsOf(const Mesh& mesh, std::uint32_t patch) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    if (mesh.element_patch[e] == patch) out.push_back(e);
  }
  return out;
}

std::vector<std::pair<glm::vec3, glm::vec3>> patchOutline(const Mesh& mesh, std::uint32_t patch) {
  // Within the patch each edge is run along once in either direction.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::uint32_t t = 0; t < mesh.triangle_element.size(); ++t) {
    if (mesh.element_patch[mesh.triangle_element[t]] != patch) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangle_vertices[3 * t + k],
                          b = mesh.triangle_vertices[3 * t + (k + 1) % 3];
      ++uses[std::minmax(a, b)];
    }
  }
  std::vector<std::pair<glm::vec3, glm::vec3>> out;
  for (const auto& [edge, count] : uses) {
    if (count == 1) out.emplace_back(mesh.vertices[edge.first].position, mesh.vertices[edge.second].position);
  }
  return out;
}

std::vector<PickedDecision> decisionsFor(const Mesh& mesh, const Pick& pick,
                                         const std::vector<PlanDecision>& plan) {
  const Surface& surface = mesh.surfaces[pick.surface];
  std::vector<PickedDecision> out = decisionsForSides(surface, pick.back);
  const auto leftOut = [&](std::string_view key) { return decisionOf(plan, key) != nullptr; };
  // A quadrilateral is two.
  if (surface.triangles.count > 2 && leftOut(plan_keys::kTriangles)) {
    out.push_back({plan_keys::kTriangles, countText(surface.triangles.count) +
                                              " triangles of the scene are one surface: same plane and "
                                              "material."});
  }
  if (pick.side == kNone) return out;
  if (leftOut(plan_keys::kOcclusion))
    out.push_back({plan_keys::kOcclusion, "Nothing can stand between two points: no occlusion is tested."});
  if (leftOut(plan_keys::kOccluders) && !surface.between) {
    out.push_back({plan_keys::kOccluders,
                   "No shadow ray asks for it: all that it could hide lies on one side of its plane."});
  }
  if (leftOut(plan_keys::kEscape)) {
    out.push_back(
        {plan_keys::kEscape, "No light is looked for that escapes: closed surfaces lie around every light."});
  }
  if (leftOut(plan_keys::kHemicubes))
    out.push_back({plan_keys::kHemicubes, "Rays find what its vertices see; no hemicube is drawn."});
  if (leftOut(plan_keys::kEvenLight) && mesh.base && pick.element != kNone)
    out.push_back({plan_keys::kEvenLight, evenLightText(mesh, pick.element)});
  if (leftOut(plan_keys::kFineness))
    out.push_back({plan_keys::kFineness, "A coarse mesh of the whole scene was tried, and is good enough."});
  if (const PlanDecision* channels = decisionOf(plan, plan_keys::kChannels))
    out.push_back({plan_keys::kChannels, "Fewer channels are summed: " + channels->why + "."});
  if (const PlanDecision* shots = decisionOf(plan, plan_keys::kShots))
    out.push_back({plan_keys::kShots, "Its light goes with that of others: " + shots->why + "."});
  const PlanDecision* idle = decisionOf(plan, plan_keys::kShooters);
  if (idle && pick.patch != kNone &&
      std::binary_search(idle->patches.begin(), idle->patches.end(), pick.patch)) {
    out.push_back({plan_keys::kShooters, idleText(mesh, pick.patch)});
  }
  return out;
}

}  // namespace unshot
