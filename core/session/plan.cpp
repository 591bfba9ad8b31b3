#include "session/plan.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "base/text.h"
#include "formfactor/methods.h"
#include "mesh/build.h"
#include "scene/sky.h"
#include "session/light_refinement.h"
#include "session/scene_checks.h"

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
// Of scenes with more than so many triangles that needs no mesh to be known.
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
          .sky = skyOver(scene, options.sky) != glm::dvec3(0.0)};
}

std::shared_ptr<const Mesh> uniformMesh(const Scene& scene, const SolveOptions& options,
                                        const CancelToken& cancel) {
  return std::make_shared<const Mesh>(buildMesh(scene, meshOptions(scene, options), cancel));
}

// The mesh to be refined, of as many elements as the error asks for.
std::shared_ptr<const Mesh> baseMesh(const Scene& scene, const SolveOptions& options,
                                     const CancelToken& cancel) {
  const double wanted = kBaseElements * std::pow(0.01 / options.error, 1 / kOrder);
  const auto elements = static_cast<std::uint64_t>(
      std::min(std::clamp(wanted, kFewestBase, kMostBase), static_cast<double>(options.max_elements)));
  MeshOptions mesh_options = meshOptions(scene, options);
  mesh_options.elements = elements;
  mesh_options.paired_cells = true;
  Mesh mesh = buildMesh(scene, mesh_options, cancel);
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
  // As fine everywhere as one in twenty elements: slivers, which cuts leave, do not count.
  std::vector<double> areas = mesh->element_area;
  const auto fine = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 20);
  std::nth_element(areas.begin(), fine, areas.end());
  plan.push_back({"fine elements where direct light is even",
                  "it is what interpolation makes of it there; other light takes the vertices of " +
                      std::to_string(mesh->base->element_count) + " even elements",
                  std::to_string(mesh->element_count) + " elements instead of some " +
                      figureText(mesh->lit_area / *fine)});
  return mesh;
}

}  // namespace

Preparation prepare(const Scene& scene, const SolveOptions& options, const CancelToken& cancel) {
  Preparation out;
  const double mesh_began = wallSeconds();
  out.form_factors = options.form_factors;
  out.sky = skyOver(scene, options.sky);
  out.mesh = options.mesh;
  const bool automatic = out.form_factors == "auto", may_follow = !options.mesh && !finenessGiven(options);
  const bool soonest = options.soonest && scene.triangle_count <= kMostTriangles;
  bool to_refine = may_follow && (automatic ? soonest : atVertices(out.form_factors));
  if (!out.mesh)
    out.mesh = to_refine ? baseMesh(scene, options, cancel) : uniformMesh(scene, options, cancel);
  PlanDecision choice;
  if (automatic) {
    const double looks =
        static_cast<double>(out.mesh->vertices.size()) * static_cast<double>(out.mesh->patch_count);
    const bool rays = soonest && looks <= kMostLooks;
    out.form_factors = nothingCanOcclude(*out.mesh) ? "closed-form" : rays ? "rays" : "hemicube";
    const bool follows = may_follow && atVertices(out.form_factors);
    if (follows != to_refine)
      out.mesh = follows ? baseMesh(scene, options, cancel) : uniformMesh(scene, options, cancel);
    to_refine = follows;
    if (out.form_factors == "rays")
      choice = {"hemicubes and OpenGL for the solution",
                "shadow rays see as much from " + std::to_string(out.mesh->vertices.size()) +
                    " vertices sooner and more exactly",
                "all pictures"};
  }
  std::vector<PlanDecision> decisions;
  if (!choice.what.empty()) decisions.push_back(choice);
  if (to_refine) out.mesh = refined(out.mesh, options, out.form_factors, decisions, cancel);
  const double plan_began = wallSeconds();
  out.plan = makePlan(scene, *out.mesh, out.form_factors);
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
  out.mesh_seconds = plan_began - mesh_began;
  out.plan_seconds = wallSeconds() - plan_began;
  return out;
}

}  // namespace unshot
