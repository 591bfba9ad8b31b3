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
#include "session/coarse_mesh.h"
#include "session/light_refinement.h"
#include "session/scene_checks.h"

namespace unshot {

namespace {

// Elements of the uniform mesh that is refined, for an error of 1 %: on the Cornell box the whole error then
// is about as large (unshot_bench --only methods).
constexpr double kBaseElements = 1'700;
// The error falls with so much of a power of their number.
constexpr double kErrorOrder = 0.75;
// Beyond, time grows with the square for little.
constexpr double kFewestBase = 160, kMostBase = 10'000;
// And so many for each lit side: as many receivers look at patches in any case, and near large ones that
// takes longer. On teapot_box (10,062 sides), --error 0.05: with it 2 s and 4.1 %, without 15 s and 5.8 %.
constexpr double kForSides = 0.1;
// Rays take a look from each vertex at each patch, hemicubes a picture of each patch and no more. So many
// looks are some ten seconds: the teapot in its box, 4e8 of them, is sooner by hemicubes, two_rooms, 4e7, by
// rays.
constexpr double kMostRayLooks = 6e7;
// Of scenes with more than so many triangles that light reaches, that needs no mesh to be known.
constexpr std::size_t kMostTriangles = 50'000;
// Of scenes with no more, hemicubes on even elements are within some percent.
constexpr std::size_t kFewTriangles = 2'000;
// Shares of the time from a large scene to the first shot: surfaces and their meshes found, the scene
// checked.
constexpr double kSurfacesShare = 0.45, kMeshShare = 0.9, kChecksShare = 0.95;
// Light straight from emitters, on a coarse mesh: its vertices cost little there.
constexpr double kFinerLight = 0.3;

bool seesFromVertices(const std::string& method) {
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
          .escape_unknown = !leavesOut(options.do_anyway, plan_keys::kEscape),
          .all_tested = !leavesOut(options.do_anyway, plan_keys::kOccluders),
          .rooms_unknown = !leavesOut(options.do_anyway, plan_keys::kOcclusion) ||
                           !leavesOut(options.do_anyway, plan_keys::kOccluders),
          .join_polygons = leavesOut(options.do_anyway, plan_keys::kTriangles),
          .sky = skyOver(scene, options.sky) != glm::dvec3(0.0)};
}

std::shared_ptr<const Mesh> uniformMesh(const SurfacesOfScene& surfaces, const MeshOptions& options,
                                        const CancelToken& cancel) {
  return std::make_shared<const Mesh>(meshSurfaces(surfaces, options, cancel));
}

double meshError(const SolveOptions& options) { return options.mesh_error.value_or(options.error); }

// As many as the error asks for, of a mesh to be refined, which has these sides.
double baseElements(const SolveOptions& options, std::size_t sides) {
  const double wanted = kBaseElements * std::pow(0.01 / meshError(options), 1 / kErrorOrder);
  const double fewest = std::max(kFewestBase, kForSides * static_cast<double>(sides));
  return std::min(std::min(std::max(wanted, fewest), kMostBase), static_cast<double>(options.max_elements));
}

// The mesh to be refined.
std::shared_ptr<const Mesh> baseMesh(const SurfacesOfScene& surfaces, MeshOptions mesh_options,
                                     double elements, const CancelToken& cancel) {
  mesh_options.elements = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(elements));
  mesh_options.paired_cells = true;
  Mesh mesh = meshSurfaces(surfaces, mesh_options, cancel);
  std::erase_if(mesh.diagnostics, [](const Diagnostic& d) { return d.code == "element-count"; });
  mesh.for_error = true;
  return std::make_shared<const Mesh>(std::move(mesh));
}

LightRefinement refinementFor(const SolveOptions& options, const std::string& method) {
  LightRefinement refinement;
  refinement.error = meshError(options);
  refinement.most_elements = options.max_elements;
  refinement.occlusion = method != "closed-form";
  refinement.seed = options.seed;
  return refinement;
}

// A coarse mesh that is good enough, if there is one. `coarsest`: see mayBeCoarse.
CoarseMesh coarseMesh(const SurfacesOfScene& surfaces, const SolveOptions& options,
                      const MeshOptions& mesh_options, const std::shared_ptr<const Mesh>& coarsest,
                      std::vector<PlanDecision>& plan, const CancelToken& cancel) {
  const double usual = baseElements(options, surfaces.mesh.sides.size());
  if (!mayBeCoarse(*coarsest, usual)) return {};
  LightRefinement refinement = refinementFor(options, "closed-form");
  refinement.error *= kFinerLight;
  refinement.emitters = coarsest;
  CoarseMesh found = findCoarseMesh(
      *coarsest,
      {.error = meshError(options),
       .usual = usual,
       .seed = options.seed,
       .fewer_channels = leavesOut(options.do_anyway, plan_keys::kChannels),
       .make =
           [&](double elements) {
             return refineForLight(baseMesh(surfaces, mesh_options, elements, cancel), refinement, cancel);
           }},
      cancel);
  if (found.mesh) plan.push_back(withoutFineness(*found.mesh, meshError(options), found.solved.error, usual));
  return found;
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
    surfaces = findSurfaces(scene, mesh_options, cancel.part(0, kSurfacesShare));
    out.plan_seconds = surfaces->plan_seconds;
  }
  const Mesh& known = surfaces ? surfaces->mesh : *out.mesh;
  const bool open = nothingCanOcclude(known);
  if (automatic && leaves(plan_keys::kOcclusion) && open) out.form_factors = "closed-form";
  const bool soonest =
      options.soonest && litTriangles(known).size() <= kMostTriangles && leaves(plan_keys::kHemicubes);
  const bool undecided = out.form_factors == "auto";
  bool to_refine = may_follow && (undecided ? soonest : seesFromVertices(out.form_factors));
  std::vector<PlanDecision> decisions;
  std::shared_ptr<const Mesh> coarsest;
  if (to_refine && open && out.form_factors == "closed-form") {
    coarsest = baseMesh(*surfaces, mesh_options, 1, cancel);
    // A live solve's materials may be edited, and its mesh stays.
    if (options.soonest && leaves(plan_keys::kFineness) && out.sky == glm::dvec3(0.0)) {
      CoarseMesh found = coarseMesh(*surfaces, options, mesh_options, coarsest, decisions, cancel);
      out.mesh = std::move(found.mesh);
      if (out.mesh) out.solved = std::move(found.solved);
    }
  }
  const bool coarse = coarsest && out.mesh;
  const auto meshed = [&](bool refinable) {
    const CancelToken part = cancel.part(kSurfacesShare, kMeshShare);
    return refinable
               ? baseMesh(*surfaces, mesh_options, baseElements(options, surfaces->mesh.sides.size()), part)
               : uniformMesh(*surfaces, mesh_options, part);
  };
  if (!out.mesh) out.mesh = meshed(to_refine);
  if (undecided) {
    const double looks =
        static_cast<double>(out.mesh->vertices.size()) * static_cast<double>(out.mesh->patch_count);
    const bool by_rays = soonest && looks <= kMostRayLooks;
    out.form_factors = by_rays ? "rays" : "hemicube";
    const bool follows = may_follow && by_rays;
    if (follows != to_refine) out.mesh = meshed(follows);
    to_refine = follows;
    out.gathers = !by_rays && surfaces && litTriangles(surfaces->mesh).size() > kFewTriangles;
    if (by_rays) decisions.push_back(withoutHemicubes(*out.mesh, meshError(options)));
  }
  surfaces.reset();
  if (to_refine && !coarse) {
    LightRefinement refinement = refinementFor(options, out.form_factors);
    refinement.emitters = coarsest;
    out.mesh = refineForLight(std::move(out.mesh), refinement, cancel);
  }
  if (to_refine && out.mesh->base) decisions.push_back(withoutEvenLight(*out.mesh, meshError(options)));
  cancel.report(kMeshShare);
  const double plan_began = wallSeconds();
  out.plan = makePlan({scene, *out.mesh, out.form_factors, options.error, options.emit_front_only, out.sky,
                       options.do_anyway});
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
  out.rays = checked.raysAtHand();
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
  cancel.report(kChecksShare);
  out.mesh_seconds = plan_began - mesh_began - out.plan_seconds;
  out.plan_seconds += wallSeconds() - plan_began;
  return out;
}

}  // namespace unshot
