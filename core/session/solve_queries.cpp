// What a solve says of itself: the light to show, how far it is, what it chose and what it costs.
#include <algorithm>
#include <cmath>

#include "session/fields.h"
#include "session/solve.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

// Of the work on a finer mesh, until the light of the coarser one is sent over it.
constexpr double kTakingOver = 0.9;

}  // namespace

// H with what the local pass adds, one per receiver.
std::vector<glm::dvec3> Solve::Impl::shownIrradiance() const {
  std::vector<glm::dvec3> out = state->irradiance();
  if (!local_pass || local_pass->irradiance().empty()) return out;
  for (std::size_t v = 0; v < out.size(); ++v) out[v] += local_pass->irradiance()[v];
  return out;
}

// With final gathering, where one has ended.
MeshField Solve::Impl::shownField() const {
  if (final_gather && final_gather->light()) return final_gather->light()->irradiance;
  return makeField(*mesh, transport->receivers(), shownIrradiance());
}

Snapshot Solve::snapshot() const {
  const Impl& s = *impl_;
  Snapshot out = makeFields(s.mesh, s.shownField(), *s.state, *s.ambient);
  out.sky = s.sky;
  out.measures = s.measures;
  impl_->shared.addTo(out, *s.transport, *s.state, s.budget->bounds());
  if (s.final_gather && s.final_gather->light()) {
    const std::shared_ptr<const GatheredLight>& light = s.final_gather->light();
    out.direct = {light, &light->direct.vertices};
    out.element_direct = {light, &light->direct.elements};
    // What was unshot has gone on in it to its end.
    std::fill(out.ambient.begin(), out.ambient.end(), glm::vec3(0.0f));
  }
  out.bounce_light = s.bounces_of_light->light();
  if (!out.bounce_light && s.mode) {
    std::vector<glm::dvec3> powers = s.mode->bouncePowers();
    if (powers.size() > 1) out.bounce_light = std::make_shared<const BounceLight>(BounceLight{powers, {}});
  }
  out.bounce_wait = s.bounces_of_light->wait();
  return out;
}

const Measures& Solve::measures() const { return impl_->measures; }

double Solve::progress() const {
  const Impl& s = *impl_;
  if (s.progress_state == SolveState::kConverged) return 1;
  if (gathers()) return s.final_gather->progress();
  if (takesOver()) return kTakingOver * s.shareTakenOver();
  if (!std::isfinite(s.measures.unshot_fraction)) return 0;
  // Until there is a bound, what is unshot says how far it is.
  const double bound = s.measures.solverBound(), left = bound < kNoBound ? bound : s.measures.unshot_fraction;
  const double reached = std::log(std::max(left, 1e-300)) / std::log(s.target());
  const double before = s.on_finer_mesh ? kTakingOver : 0;
  return before + (1 - before) * std::clamp(reached, 0.0, 0.999);
}

bool Solve::gathers() const { return impl_->final_gather && impl_->final_gather->running(); }

const void* Solve::gathered() const {
  return impl_->final_gather ? impl_->final_gather->light().get() : nullptr;
}

std::string Solve::activity() const {
  const Impl& s = *impl_;
  if (s.progress_state != SolveState::kRunning) return {};
  if (takesOver()) return "refining the mesh";
  if (gathers()) return "gathering";
  return s.mode ? s.mode->activity() : std::string();
}

EnergyBalance Solve::energy() const { return energyOf(*impl_->transport, *impl_->state); }

std::vector<glm::dvec3> Solve::patchRadiosity() const {
  std::vector<glm::dvec3> out = impl_->state->shot();
  for (std::size_t q = 0; q < out.size(); ++q) out[q] += impl_->state->unshot()[q];
  return out;
}

bool Solve::sumRows() { return impl_->shared.sumRows(*impl_->mesh, *impl_->transport, *impl_->state); }
BounceWait Solve::bounceWait() const { return impl_->bounces_of_light->wait(); }

bool Solve::hasBouncesToWorkOut(bool compute) const { return impl_->bounces_of_light->hasWork(compute); }
std::size_t Solve::places() const { return impl_->budget->places(); }
double Solve::errorSeconds() const { return impl_->budget->seconds(); }
const ErrorBounds& Solve::bounds() const { return impl_->budget->bounds(); }
const ErrorEstimates& Solve::estimates() const { return impl_->budget->estimates(); }
double Solve::solverTarget() const { return impl_->target(); }
SolveState Solve::state() const { return impl_->progress_state; }
const glm::dvec3& Solve::sky() const { return impl_->sky; }
const SolveOptions& Solve::options() const { return impl_->options; }
const Scene& Solve::scene() const { return impl_->scene; }
const Mesh& Solve::mesh() const { return *impl_->mesh; }
const std::string& Solve::modeKey() const { return impl_->mode_key; }
const std::string& Solve::formFactorsKey() const { return impl_->form_factors_key; }
const std::vector<PlanDecision>& Solve::plan() const { return impl_->plan; }
const Diagnostics& Solve::diagnostics() const { return impl_->diagnostics; }
const std::vector<HistoryEntry>& Solve::history() const { return impl_->history; }
const PhaseSeconds& Solve::seconds() const { return impl_->seconds; }
std::size_t Solve::keptBytes() const { return impl_->transport->keptBytes(); }

std::size_t Solve::workingBytes() const {
  const RadiosityState& state = *impl_->state;
  // Per patch E, rho, S, U, E left and A; per receiver H and H_d.
  return state.patchCount() * (5 * sizeof(glm::dvec3) + sizeof(double)) +
         2 * state.irradiance().size() * sizeof(glm::dvec3) + (impl_->mode ? impl_->mode->bytes() : 0);
}

std::uint64_t Solve::drawn() const { return impl_->drawn_before + impl_->transport->drawn(); }
const std::string& Solve::stoppedBy() const { return impl_->stopped_by; }
const std::optional<Error>& Solve::failure() const { return impl_->failure; }

}  // namespace unshot
