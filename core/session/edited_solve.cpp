// How a solve goes on with other materials: S and H stay, and so does K, which is a matter of geometry. What
// the edit changes shows up as unshot, of either sign.
//
// Only what a patch is to K can change: an emitter's column is exact at each vertex, those of others may be
// coarser. Where a patch begins or ceases to emit, its column is computed anew, and H follows.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "base/clock.h"
#include "base/text.h"
#include "scene/scene_hash.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

// Of the power that a channel has had, from which on its light is shot anew.
constexpr double kLeastLeft = 1e-6;

void checkMaterials(const std::vector<Material>& now, const std::vector<Material>& materials) {
  if (materials.size() != now.size()) {
    throw Error(ErrorKind::kUsage, "the scene has " + std::to_string(now.size()) + " materials, not " +
                                       std::to_string(materials.size()));
  }
  for (std::size_t m = 0; m < now.size(); ++m) {
    for (int c = 0; c < 3; ++c) {
      const double rho = materials[m].reflectance[c], e = materials[m].emission[c];
      if (!(rho >= 0 && rho <= 1))
        throw Error(ErrorKind::kUsage, "a reflectance must be 0 to 1, not " + figureText(rho), now[m].name);
      if (!(e >= 0 && std::isfinite(e)))
        throw Error(ErrorKind::kUsage, "an emission must be 0 or more, not " + figureText(e), now[m].name);
    }
  }
}

std::shared_ptr<const Mesh> withMaterials(const Mesh& mesh, const std::vector<Material>& materials,
                                          bool emit_front_only) {
  auto out = std::make_shared<Mesh>(mesh);
  out->materials = materials;
  for (Side& side : out->sides) {
    const Material& material = materials[out->surfaces[side.surface].material];
    const bool emitted = side.emission != glm::dvec3(0.0);
    side.reflectance = material.reflectance;
    if (!side.back || !emit_front_only) side.emission = material.emission;
    // It may reach beyond the surfaces that lay around every light.
    if (!emitted && side.emission != glm::dvec3(0.0)) out->closed = false;
  }
  if (mesh.base) out->base = withMaterials(*mesh.base, materials, emit_front_only);
  return out;
}

// Whether some side emits other light; the meshes have the same.
bool emissionDiffers(const Mesh& a, const Mesh& b) {
  for (std::size_t k = 0; k < a.sides.size(); ++k)
    if (a.sides[k].emission != b.sides[k].emission) return true;
  return false;
}

bool isMade(const std::vector<PlanDecision>& plan, const std::string& key) {
  return std::any_of(plan.begin(), plan.end(), [&](const PlanDecision& d) { return d.key == key; });
}

}  // namespace

Scene editedScene(Scene scene, const std::vector<Material>& materials) {
  checkMaterials(scene.materials, materials);
  if (scene.materials == materials) return scene;
  scene.hash_as_read = sceneHash(scene);
  for (std::size_t m = 0; m < materials.size(); ++m) {
    scene.materials[m].reflectance = materials[m].reflectance;
    scene.materials[m].emission = materials[m].emission;
  }
  return scene;
}

bool Solve::canEdit(const std::vector<Material>& materials) const {
  const Mesh& mesh = *impl_->mesh;
  return std::none_of(mesh.surfaces.begin(), mesh.surfaces.end(), [&](const Surface& s) {
    if (!materials.at(s.material).emits() || mesh.materials[s.material].emits()) return false;
    const auto dark = [&](int back) { return s.side[back] == kNone && !s.outer[back]; };
    return dark(0) || (dark(1) && !impl_->options.emit_front_only);
  });
}

Solve::Solve(Solve& before, const std::vector<Material>& materials, const std::function<gl::Context&()>& gl,
             const CancelToken& cancel)
    : impl_(std::make_unique<Impl>(before.impl_->scene, before.impl_->options)) {
  Impl& s = *impl_;
  Impl& b = *before.impl_;
  s.scene = editedScene(std::move(s.scene), materials);
  if (!before.canEdit(materials)) {
    throw Error(ErrorKind::kUsage, "surfaces of this material lie where no light came, and have no elements",
                {}, "a restart, which gives them some");
  }
  s.options.form_factors = b.form_factors_key;
  s.options.sky = b.sky;
  s.options.mesh = withMaterials(*b.mesh, s.scene.materials, b.options.emit_front_only);
  s.setUp(gl, cancel);
  s.takeOver(b);
}

// All that may throw comes before the form factors go over.
void Solve::Impl::takeOver(Impl& before) {
  for (const PlanDecision& decision : before.plan) {
    const bool of_the_mesh = decision.key == plan_keys::kHemicubes || decision.key == plan_keys::kEvenLight ||
                             decision.key == plan_keys::kFineness;
    if (of_the_mesh && !isMade(plan, decision.key)) plan.push_back(decision);
  }
  mesh_error = before.mesh_error;
  relit = before.relit || emissionDiffers(*before.mesh, *mesh);
  chooseMode(options.mode);
  Transport& theirs = *before.transport;
  std::vector<char> another(transport->patchCount());  // columns, as the patch begins or ceases to emit
  for (std::uint32_t q = 0; q < mesh->patch_count; ++q) another[q] = mesh->emits(q) != before.mesh->emits(q);
  // Rows were closed with other columns then; all of those are at hand.
  const bool reopen =
      !theirs.closure().scale.empty() && std::find(another.begin(), another.end(), 1) != another.end();
  std::vector<std::pair<std::uint32_t, Column>> former;
  for (std::uint32_t q = 0; q < mesh->patch_count && !reopen; ++q) {
    if (another[q] && before.state->shot()[q] != glm::dvec3(0.0)) former.emplace_back(q, theirs.column(q));
  }

  SavedSolve saved = before.head();
  saved.plan = std::move(plan);
  saved.values = before.state->values();
  saved.closure_pending = reopen || saved.closure.scale.empty();
  if (reopen) saved.closure = {};
  if (before.local_pass) saved.local_irradiance = before.local_pass->irradiance();
  saved.state = SolveState::kRunning;
  for (std::uint32_t q = 0; q < transport->patchCount(); ++q) {
    if (another[q])
      saved.quality[q] = SavedSolve::kUnused;
    else if (std::optional<Column> column = theirs.take(q, reopen))
      saved.columns.emplace_back(q, std::move(*column));
  }
  restore(saved);
  state->setFormerEmission(before.state->emission());
  if (reopen) {
    state->relabelEmission();
    state->renew(*transport);
  } else {
    for (const auto& [q, column] : former) {
      const Column& present = transport->column(q);
      state->relabelEmission(q, column, present);
      state->replaceColumn(q, column, present);
    }
    for (std::uint32_t q = 0; q < transport->patchCount(); ++q) {
      if (!state->isMislabelled(q)) continue;
      const Column& column = transport->column(q);
      state->relabelEmission(q, column, column);
    }
  }
  state->balance();
  const glm::dvec3 emitted = state->emittedPowers();
  most_emitted = glm::max(before.most_emitted, before.state->emittedPowers());
  for (int c = 0; c < 3; ++c) {
    // What is left of so much more light, taken back, would be rounding.
    if (emitted[c] > kLeastLeft * most_emitted[c]) continue;
    state->resetChannel(c);
    most_emitted[c] = 0;
  }
  solve_start = wallSeconds();
  takeUp(saved);
  if (state->emittedPower() <= 0) endWithoutLight();
  measure();
  stagnation.restart(measures);
}

}  // namespace unshot
