#include "session/plan.h"

#include "base/clock.h"
#include "formfactor/methods.h"
#include "mesh/build.h"

namespace unshot {

std::vector<PlanDecision> makePlan(const Scene& scene, const Mesh& mesh, const std::string& form_factors) {
  std::vector<PlanDecision> out;
  const std::size_t all_sides = 2 * mesh.surfaces.size(), unlit = all_sides - mesh.sides.size();
  if (unlit > 0) {
    double area = -mesh.lit_area;
    for (const Surface& s : mesh.surfaces) area += 2 * s.area;
    out.push_back(
        {"elements on " + std::to_string(unlit) + " of " + std::to_string(all_sides) + " surface sides",
         "nothing of the scene lies in front of them, so no light can reach them",
         std::to_string(static_cast<int>(100 * area / (area + mesh.lit_area) + 0.5)) + " % of the elements"});
  }
  if (scene.triangle_count > mesh.surfaces.size()) {
    out.push_back({"borders inside " + std::to_string(mesh.surfaces.size()) + " surfaces",
                   std::to_string(scene.triangle_count) +
                       " triangles of the scene join into them: same plane and material",
                   "elements as fine as the light needs, not as the input was cut"});
  }
  if (form_factors == "closed-form" && nothingCanOcclude(mesh)) {
    out.push_back({"occlusion tests, hemicubes and OpenGL for the solution",
                   "every surface has the whole scene on one side of its plane, so nothing can stand between "
                   "two points",
                   "all pictures; the form factors are exact"});
  }
  std::size_t black = 0;
  for (const std::uint32_t side : mesh.patch_side) {
    black += mesh.sides[side].reflectance == glm::dvec3(0.0) && mesh.sides[side].emission == glm::dvec3(0.0);
  }
  if (black > 0) {
    out.push_back(
        {"shots from " + std::to_string(black) + " of " + std::to_string(mesh.patch_count) + " patches",
         "they are black and send nothing", "their columns"});
  }
  return out;
}

Preparation prepare(const Scene& scene, const SolveOptions& options, const CancelToken& cancel) {
  Preparation out;
  const double mesh_began = wallSeconds();
  out.mesh = options.mesh
                 ? options.mesh
                 : std::make_shared<const Mesh>(buildMesh(
                       scene, {options.elements, options.element_size, options.emit_front_only}, cancel));
  const double plan_began = wallSeconds();
  out.form_factors = options.form_factors;
  if (out.form_factors == "auto")
    out.form_factors = nothingCanOcclude(*out.mesh) ? "closed-form" : "hemicube";
  out.plan = makePlan(scene, *out.mesh, out.form_factors);
  out.diagnostics = scene.diagnostics;
  out.diagnostics.insert(out.diagnostics.end(), out.mesh->diagnostics.begin(), out.mesh->diagnostics.end());
  const FormFactorMethodRow& row = findChoice(formFactorMethods(), out.form_factors, "form-factor method");
  const std::string unsuited = row.unsuited(*out.mesh);
  if (!unsuited.empty()) {
    out.diagnostics.push_back({Severity::kWarning, "unsuited-method", unsuited, {}, "--form-factors auto"});
  }
  if (options.hemicube_resolution != 0 && !row.needs_gl) {
    out.diagnostics.push_back({Severity::kNote,
                               "unused-resolution",
                               "the form factors '" + out.form_factors +
                                   "' take no hemicubes: the resolution asked for them has no effect",
                               {},
                               "--form-factors hemicube"});
  }
  out.mesh_seconds = plan_began - mesh_began;
  out.plan_seconds = wallSeconds() - plan_began;
  return out;
}

}  // namespace unshot
