#include "session/preparation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/clock.h"
#include "base/text.h"
#include "formfactor/methods.h"
#include "mesh/build.h"
#include "mesh/lit.h"
#include "scene/sky.h"
#include "session/light_refinement.h"
#include "session/scene_checks.h"

namespace unshot {

namespace {

// Elements of the uniform mesh that is refined, for an error of 1 %: on the Cornell box the whole error then
// is about as large (unshot_bench --only methods).
constexpr double kBaseElements = 2'500;
// The error falls with so much of a power of their number.
constexpr double kOrder = 0.75;
// Beyond, time grows with the square for little.
constexpr double kFewestBase = 100, kMostBase = 10'000;
// Rays take a look from each vertex at each patch, hemicubes a picture of each patch and no more. So many
// looks are some ten seconds: the teapot in its box, 4e8 of them, is sooner by hemicubes, two_rooms, 4e7, by
// rays.
constexpr double kMostLooks = 6e7;
// Of scenes with more than so many triangles that light reaches, that needs no mesh to be known.
constexpr std::size_t kMostTriangles = 50'000;

bool atVertices(const std::string& method) {
  return findChoice(formFactorMethods(), method, "form-factor method").receivers == ReceiverKind::kVertices;
}

bool finenessGiven(const SolveOptions& options) { return options.elements || options.element_size; }

MeshOptions meshOptions(const Scene& scene, const SolveOptions& options) {
  return {.elements = options.elements,
          .element_size = options.element_size,
          .emit_front_only = options.emit_front_only,
          .paired_cells = false,
          .outer_sides = !leavesOut(options.do_anyway, plan_keys::kOuterSides),
          .dark_sides = !leavesOut(options.do_anyway, plan_keys::kDarkSides),
          .join_polygons = leavesOut(options.do_anyway, plan_keys::kTriangles),
          .sky = skyOver(scene, options.sky) != glm::dvec3(0.0)};
}

std::shared_ptr<const Mesh> uniformMesh(const SurfacesOfScene& surfaces, const MeshOptions& options,
                                        const CancelToken& cancel) {
  return std::make_shared<const Mesh>(meshSurfaces(surfaces, options, cancel));
}

// The mesh to be refined, of as many elements as the error asks for.
std::shared_ptr<const Mesh> baseMesh(const SurfacesOfScene& surfaces, const SolveOptions& options,
                                     MeshOptions mesh_options, const CancelToken& cancel) {
  const double wanted = kBaseElements * std::pow(0.01 / options.error, 1 / kOrder);
  const auto elements = static_cast<std::uint64_t>(
      std::min(std::clamp(wanted, kFewestBase, kMostBase), static_cast<double>(options.max_elements)));
  mesh_options.elements = elements;
  mesh_options.paired_cells = true;
  Mesh mesh = meshSurfaces(surfaces, mesh_options, cancel);
  std::erase_if(mesh.diagnostics, [](const Diagnostic& d) { return d.code == "element-count"; });
  return std::make_shared<const Mesh>(std::move(mesh));
}

std::shared_ptr<const Mesh> refined(std::shared_ptr<const Mesh> base, const SolveOptions& options,
                                    const std::string& method, std::vector<PlanDecision>& plan,
                                    const CancelToken& cancel) {
  LightRefinement refinement;
  refinement.error = options.error;
  refinement.most_elements = options.max_elements;
  refinement.occlusion = method != "closed-form";
  refinement.seed = options.seed;
  std::shared_ptr<const Mesh> mesh = refineForLight(std::move(base), refinement, cancel);
  if (!mesh->base) return mesh;
  plan.push_back(withoutEvenLight(*mesh));
  return mesh;
}

}  // namespace

Preparation prepare(const Scene& scene, const SolveOptions& options, const CancelToken& cancel) {
  Preparation out;
  const double mesh_began = wallSeconds();
  out.form_factors = options.form_factors;
  out.sky = skyOver(scene, options.sky);
  out.mesh = options.mesh;
  const auto leaves = [&](std::string_view key) { return leavesOut(options.do_anyway, key); };
  const bool automatic = out.form_factors == "auto";
  const bool may_follow = !options.mesh && !finenessGiven(options) && leaves(plan_keys::kEvenLight);
  const MeshOptions mesh_options = meshOptions(scene, options);
  std::optional<SurfacesOfScene> surfaces;
  if (!out.mesh) {
    surfaces = findSurfaces(scene, mesh_options, cancel);
    out.plan_seconds = surfaces->plan_seconds;
  }
  const std::size_t triangles = litTriangles(surfaces ? surfaces->mesh : *out.mesh).size();
  const bool soonest = options.soonest && triangles <= kMostTriangles && leaves(plan_keys::kHemicubes);
  const auto meshed = [&](bool to_refine) {
    return to_refine ? baseMesh(*surfaces, options, mesh_options, cancel)
                     : uniformMesh(*surfaces, mesh_options, cancel);
  };
  bool to_refine = may_follow && (automatic ? soonest : atVertices(out.form_factors));
  if (!out.mesh) out.mesh = meshed(to_refine);
  bool by_rays = false;
  if (automatic) {
    const double looks =
        static_cast<double>(out.mesh->vertices.size()) * static_cast<double>(out.mesh->patch_count);
    const bool closed_form = leaves(plan_keys::kOcclusion) && nothingCanOcclude(*out.mesh);
    by_rays = !closed_form && soonest && looks <= kMostLooks;
    out.form_factors = closed_form ? "closed-form" : by_rays ? "rays" : "hemicube";
    const bool follows = may_follow && atVertices(out.form_factors);
    if (follows != to_refine) out.mesh = meshed(follows);
    to_refine = follows;
  }
  surfaces.reset();
  std::vector<PlanDecision> decisions;
  if (by_rays) decisions.push_back(withoutHemicubes(*out.mesh));
  if (to_refine) out.mesh = refined(out.mesh, options, out.form_factors, decisions, cancel);
  const double plan_began = wallSeconds();
  out.plan = makePlan(scene, *out.mesh, out.form_factors, options.do_anyway);
  out.plan.insert(out.plan.end(), decisions.begin(), decisions.end());
  out.diagnostics = scene.diagnostics;
  out.diagnostics.insert(out.diagnostics.end(), out.mesh->diagnostics.begin(), out.mesh->diagnostics.end());
  if (!options.sky && out.sky != glm::dvec3(0.0)) {
    out.diagnostics.push_back({Severity::kNote,
                               "sky",
                               "as no face emits light, a uniform sky of 1 W/m^2 lights the scene",
                               {},
                               "--sky r,g,b for another, --sky 0,0,0 for none"});
  }
  CheckedScene checked(scene, *out.mesh, options.emit_front_only, cancel);
  const Diagnostics found = checkScene(checked, CheckTime::kEverySolve);
  out.diagnostics.insert(out.diagnostics.end(), found.begin(), found.end());
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
  out.mesh_seconds = plan_began - mesh_began - out.plan_seconds;
  out.plan_seconds += wallSeconds() - plan_began;
  return out;
}

}  // namespace unshot
