// How a solve goes on on a finer mesh, or on one for the light as it is now: a patch that is divided hands
// what it has shot to its parts, H follows with their columns, and what the finer mesh finds otherwise is
// unshot, of either sign.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "base/clock.h"
#include "mesh/grid.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

// Of the elements allowed: with more there is no finer mesh.
constexpr double kNearlyAll = 0.9;
// That a mesh is far from the error asked for takes an estimate from so many places to say.
constexpr std::size_t kSurePlaces = 512;

// Its patches are those of the mesh.
const Mesh& patchMesh(const Mesh& mesh) { return mesh.base ? *mesh.base : mesh; }

// The patch of `mesh` at this place on a side of one of its surfaces; kNone where it has none there.
std::uint32_t patchAt(const Mesh& mesh, std::uint32_t surface, bool back, const glm::dvec3& place) {
  const Surface& s = mesh.surfaces[surface];
  const std::uint32_t side = s.side[back];
  if (side == kNone) return kNone;
  const std::uint32_t local = elementAt(mesh, s, s.chart(place));
  return local == kNone ? kNone : mesh.element_patch[mesh.sides[side].first_element + local];
}

// Means over the patches of `finer` of what those of `coarser` have, which are of the same surfaces.
std::vector<glm::dvec3> handedOver(const Mesh& coarser, const std::vector<glm::dvec3>& values,
                                   const Mesh& finer) {
  std::vector<glm::dvec3> out(finer.patch_count, glm::dvec3(0.0));
  for (std::uint32_t e = 0; e < finer.element_count; ++e) {
    const Side& side = finer.sides[finer.element_side[e]];
    const Surface& surface = finer.surfaces[side.surface];
    const glm::dvec3& centre = finer.shapes[surface.elements.first + e - side.first_element].centre;
    const std::uint32_t patch = patchAt(coarser, side.surface, side.back, centre);
    const std::uint32_t q = finer.element_patch[e];
    if (patch != kNone) out[q] += finer.element_area[e] / finer.patch_area[q] * values[patch];
  }
  return out;
}

double power(double area, const glm::dvec3& x) {
  return area * (std::abs(x.x) + std::abs(x.y) + std::abs(x.z));
}

}  // namespace

std::optional<double> Solve::finerMeshError() const { return impl_->finerMeshError(); }

bool Solve::takesOver() const { return !impl_->hand_order.empty(); }

std::optional<double> Solve::Impl::finerMeshError() const {
  const bool whole = progress_state == SolveState::kConverged && state->emittedPower() > 0;
  if (!whole || !endsNearTheTruth()) return std::nullopt;
  const auto elements = static_cast<double>(mesh->element_count);
  if (elements >= kNearlyAll * static_cast<double>(options.max_elements)) return std::nullopt;
  if (options.error < mesh_error) return options.error;
  const bool sure = budget->places() >= kSurePlaces;
  return relit && sure && missesError() ? std::optional(mesh_error) : std::nullopt;
}

Solve::Solve(const Solve& before, const std::function<gl::Context&()>& gl, const CancelToken& cancel)
    : impl_(std::make_unique<Impl>(before.impl_->scene, before.impl_->options)) {
  Impl& s = *impl_;
  const Impl& b = *before.impl_;
  s.options.mesh_error = b.finerMeshError();
  if (!s.options.mesh_error)
    throw Error(ErrorKind::kUsage, "the mesh is as fine as it is asked to be", {}, "a smaller --error");
  s.options.mesh.reset();
  s.options.form_factors = b.form_factors_key;
  s.options.sky = b.sky;
  s.setUp(gl, cancel);
  s.takeLightOf(b);
}

void Solve::Impl::takeLightOf(const Impl& before) {
  if (before.mesh->surfaces.size() != mesh->surfaces.size())
    throw Error(ErrorKind::kInternal, "a finer mesh has other surfaces");
  const auto chosen = std::find_if(before.plan.begin(), before.plan.end(),
                                   [](const PlanDecision& d) { return d.key == plan_keys::kHemicubes; });
  if (chosen != before.plan.end()) plan.push_back(*chosen);
  on_finer_mesh = true;
  most_emitted = before.most_emitted;
  chooseMode(options.mode);
  if (!begun_solved) {
    handed = handedOver(patchMesh(*before.mesh), before.state->shot(), patchMesh(*mesh));
    // What stands behind all patches is the sky, in both.
    if (transport->patchCount() > mesh->patch_count) handed.push_back(before.state->shot().back());
    for (std::uint32_t q = 0; q < handed.size(); ++q)
      if (handed[q] != glm::dvec3(0.0)) hand_order.push_back(q);
    std::stable_sort(hand_order.begin(), hand_order.end(), [this](std::uint32_t a, std::uint32_t b) {
      return power(state->area()[a], handed[a]) < power(state->area()[b], handed[b]);
    });
  }
  handed_count = std::max<std::size_t>(1, hand_order.size());
  solve_start -= before.measures.seconds;
  cpu_start -= before.measures.cpu_seconds;
  seconds.mesh += before.seconds.mesh;
  seconds.plan += before.seconds.plan;
  measures.shots = before.measures.shots;
  rows_before = transport->computed() - before.measures.rows;
  drawn_before = before.drawn_before + before.transport->drawn();
  history = before.history;
  measure();
  stagnation.restart(measures);
}

double Solve::Impl::shareTakenOver() const {
  return 1 - static_cast<double>(hand_order.size()) / static_cast<double>(handed_count);
}

// Of one patch a step, the brightest first.
void Solve::Impl::sendHanded() {
  const std::uint32_t q = hand_order.back();
  state->shoot(q, handed[q], transport->column(q));
  hand_order.pop_back();
  ++measures.shots;
  measure();
  if (hand_order.empty()) {
    handed = {};
    stagnation.restart(measures);
    record();
  } else if (options.max_seconds && measures.seconds >= *options.max_seconds) {
    stop(SolveState::kLimit, "max_seconds");
  }
}

}  // namespace unshot
