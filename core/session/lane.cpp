#include "session/lane.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "session/solve_inside.h"

namespace unshot {
namespace {

// Errors are estimated from so many places while the solve runs and when it rests.
constexpr std::size_t kPlacesInPassing = 128, kPlacesAtRest = 512, kPlacesAtOnce = 64;
// Share of the solver's time that estimates may take on the way, beside bounds (1 to 6 %).
constexpr double kEstimateShare = 0.01;
// What the first is taken to cost, of the time that meshing took: it looks at the whole mesh.
constexpr double kFirstEstimate = 0.25;
// Of the columns, which are computed at rest unasked.
constexpr double kFewMissing = 0.02;
// An estimate passes over the whole mesh: on a larger one it would be felt as a pause.
constexpr std::size_t kMostElementsInPassing = 200'000;

/// Line in the scene's file of one polygon of each surface.
std::vector<std::uint32_t> linesOf(const Scene& scene, const Mesh& mesh) {
  std::vector<std::uint32_t> out;
  for (const Surface& surface : mesh.surfaces) out.push_back(scene.polygons[surface.polygon].line);
  return out;
}

}  // namespace

Lane::Lane(std::unique_ptr<Solve> solve, SolveOptions asked, double load_seconds,
           std::function<void(Error)> note)
    : solve_(std::move(solve)),
      note_(std::move(note)),
      surface_lines_(
          std::make_shared<const std::vector<std::uint32_t>>(linesOf(solve_->scene(), solve_->mesh()))) {
  const double began = wallSeconds();
  snapshot_ = std::make_shared<const Snapshot>(solve_->snapshot());
  pace_.made(began, wallSeconds());
  learnFacts(std::move(asked), load_seconds);
}

void Lane::learnFacts(SolveOptions asked, double load_seconds) {
  auto facts = std::make_shared<SolveFacts>();
  const Scene& scene = solve_->scene();
  const Mesh& mesh = solve_->mesh();
  facts->scene_path = scene.path;
  facts->scene_name = scene.name;
  facts->options = std::move(asked);
  facts->options.mode = solve_->options().mode;
  facts->options.error = solve_->options().error;
  facts->solver_target = solve_->solverTarget();
  facts->mode = solve_->modeKey();
  facts->form_factors = solve_->formFactorsKey();
  facts->plan = solve_->plan();
  facts->diagnostics = solve_->diagnostics();
  facts->triangles = scene.triangle_count;
  facts->surface_lines = surface_lines_;
  facts->surfaces = mesh.surfaces.size();
  facts->patches = mesh.patch_count;
  facts->elements = mesh.element_count;
  facts->vertices = mesh.vertices.size();
  facts->load_seconds = load_seconds;
  facts->mesh_seconds = solve_->seconds().mesh;
  facts_ = std::move(facts);
}

SessionPhase Lane::phase(bool paused) const {
  if (broken()) return SessionPhase::kFailed;
  switch (active().state()) {
    case SolveState::kRunning:
      return paused ? SessionPhase::kPaused : SessionPhase::kRunning;
    case SolveState::kConverged:
      return SessionPhase::kConverged;
    case SolveState::kFailed:
      return SessionPhase::kFailed;
    default:
      return SessionPhase::kStopped;
  }
}

void Lane::checkUsable() const {
  if (broken()) throw Error(ErrorKind::kUsage, "the solve has failed and cannot go on", {}, "restart it");
}

Solve& Lane::usable() {
  checkUsable();
  return *solve_;
}

void Lane::forgetFinerMesh() {
  finer_.reset();
  no_finer_mesh_ = false;
}

bool Lane::wantsFinerMesh() const {
  return !broken() && !finer_ && !no_finer_mesh_ && solve_->finerMeshError().has_value();
}

void Lane::refineMesh(const std::function<gl::Context&()>& gl, const CancelToken& cancel) {
  no_finer_mesh_ = true;
  finer_ = std::make_unique<Solve>(*solve_, gl, cancel);
  no_finer_mesh_ = false;
}

void Lane::takeFinerMesh() {
  if (finer_->state() != SolveState::kConverged) {
    if (finer_->failure()) note_(*finer_->failure());
    finer_.reset();
    no_finer_mesh_ = true;
    return;
  }
  looking_on_.reset();
  solve_ = std::move(finer_);
  no_more_places_ = no_more_bounces_ = false;
  stale_ = estimates_stale_ = true;
  pace_ = {};
  last_estimate_seconds_ = 0;
  history_.reset();
  learnFacts(facts_->options, facts_->load_seconds);
}

void Lane::setMode(const std::string& key) {
  forgetFinerMesh();
  usable().setMode(key);
  failure_noted_ = false;
  learnFacts(facts_->options, facts_->load_seconds);
}

void Lane::setError(double error) {
  forgetFinerMesh();
  usable().setError(error);
  learnFacts(facts_->options, facts_->load_seconds);
}

void Lane::again() {
  forgetFinerMesh();
  usable().again();
  if (looking_on_) {
    const InsightWanted wanted = looking_on_->wanted();
    looking_on_.emplace(*solve_).want(wanted);
  }
  history_.reset();
  failure_noted_ = false;
  bound_seconds_ = estimate_seconds_ = 0;
  stale_ = estimates_stale_ = true;
  pace_ = {};
}

void Lane::edit(const std::vector<Material>& materials, const std::function<gl::Context&()>& gl,
                const CancelToken& cancel) {
  forgetFinerMesh();
  auto edited = std::make_unique<Solve>(usable(), materials, gl, cancel);
  const InsightWanted wanted = looking_on_ ? looking_on_->wanted() : InsightWanted();
  if (std::exchange(looking_on_, std::nullopt)) looking_on_.emplace(*edited).want(wanted);
  solve_ = std::move(edited);
  failure_noted_ = no_more_places_ = no_more_bounces_ = false;
  stale_ = estimates_stale_ = true;
  pace_ = {};  // the snapshot shows the materials at once
  learnFacts(facts_->options, facts_->load_seconds);
}

void Lane::completeBounces(bool wanted) {
  usable();
  complete_bounces_ = wanted;
  most_missing_ = 0;
}

std::optional<double> Lane::completing() const {
  if (!complete_bounces_ || broken() || !hasBounceWork()) return std::nullopt;
  const std::size_t missing = solve_->bounceWait().columns;
  if (missing == 0) return std::nullopt;
  return 1 - static_cast<double>(missing) / static_cast<double>(std::max(most_missing_, missing));
}

void Lane::lookInto(const InsightWanted& wanted) {
  if (!looking_on_) looking_on_.emplace(*solve_);
  looking_on_->want(wanted);
  const std::optional<std::uint32_t> patch = looking_on_->wanted().patch;
  if (patch && !broken()) {
    computeColumn(*solve_, *patch);
    stale_ = true;
  }
  refreshInsight(true);
}

void Lane::step(std::uint64_t most_shots) {
  if (finer_) {
    finer_->step(most_shots);
    if (finer_->state() != SolveState::kRunning) takeFinerMesh();
    return;
  }
  const double before = solve_->errorSeconds();
  const bool alone = looking_on_ && most_shots == 1;
  const bool gathering = solve_->gathers();
  const void* gathered = solve_->gathered();
  try {
    if (alone) looking_on_->beforeStep();
    solve_->step(most_shots);
    if (alone) looking_on_->afterStep();
    bound_seconds_ += solve_->errorSeconds() - before;
    // While light is gathered, all that is shown stays as it is but at the ends of its rounds.
    if (gathering && solve_->gathers() && solve_->gathered() == gathered) return;
    stale_ = estimates_stale_ = true;
    estimateInPassing();
  } catch (...) {
    const Error error = presentError();
    broken_ = error.what();
    note_(error);
  }
}

void Lane::noteFailure() {
  if (broken() || failure_noted_ || solve_->state() != SolveState::kFailed) return;
  failure_noted_ = true;
  note_(*solve_->failure());
}

bool Lane::hasSpareWork() const {
  if (broken() || !hasLight()) return false;
  if (hasBounceWork() || (looking_on_ && looking_on_->hasWork())) return true;
  return !no_more_places_ && (estimates_stale_ || solve_->places() < kPlacesAtRest);
}

// Nothing shot yet says nothing.
bool Lane::hasLight() const {
  return solve_->measures().shots > 0 && std::isfinite(solve_->measures().unshot_fraction);
}

// Where few are missing, nobody has to ask.
bool Lane::completesBounces() const {
  const auto missing = static_cast<double>(solve_->bounceWait().columns);
  return complete_bounces_ || missing <= kFewMissing * static_cast<double>(facts_->patches);
}

bool Lane::hasBounceWork() const {
  return hasLight() && !no_more_bounces_ && solve_->hasBouncesToWorkOut(completesBounces());
}

bool Lane::spareWork(double interval) {
  bool show = true;
  if (hasBounceWork()) {
    show = workOutBounces(interval);
  } else if (looking_on_ && looking_on_->hasWork()) {
    show = gather();
  } else {
    // When those in passing were chosen is a matter of time: an estimate at rest is the same each time.
    if (std::exchange(places_in_passing_, false)) solve_->forgetPlaces();
    estimateFrom(std::min(kPlacesAtOnce, kPlacesAtRest - std::min(kPlacesAtRest, solve_->places())));
  }
  if (!sumRows()) return show;
  stale_ = true;
  return true;
}

bool Lane::sumRows() {
  try {
    return solve_->sumRows();
  } catch (...) {
    noteException();
    return false;
  }
}

bool Lane::gather() {
  try {
    return looking_on_->work();
  } catch (...) {
    noteException();
    looking_on_.reset();
    return true;
  }
}

void Lane::refreshInsight(bool at_once) {
  if (!looking_on_) return;
  try {
    looking_on_->refresh(at_once);
  } catch (...) {
    noteException();
    looking_on_.reset();
  }
}

bool Lane::workOutBounces(double interval) {
  try {
    if (complete_bounces_) most_missing_ = std::max(most_missing_, solve_->bounceWait().columns);
    if (!solve_->workOutBounces(completesBounces())) return false;
  } catch (...) {
    noteException();
    no_more_bounces_ = true;
  }
  stale_ = true;
  return !hasBounceWork() || due(interval);
}

void Lane::estimateInPassing() {
  if (!running() || facts_->elements > kMostElementsInPassing) return;
  const double expected =
      last_estimate_seconds_ > 0 ? last_estimate_seconds_ : kFirstEstimate * facts_->mesh_seconds;
  if (estimate_seconds_ + expected > kEstimateShare * solve_->measures().seconds) return;
  const double began = wallSeconds();
  places_in_passing_ = true;
  estimateFrom(solve_->places() < kPlacesInPassing ? kPlacesInPassing / 8 : 0);
  last_estimate_seconds_ = wallSeconds() - began;
  estimate_seconds_ += last_estimate_seconds_;
}

void Lane::estimateFrom(std::size_t more_places) {
  const std::size_t before = solve_->places();
  try {
    solve_->estimate(more_places);
    no_more_places_ = more_places > 0 && solve_->places() == before;
  } catch (...) {
    noteException();
    no_more_places_ = true;
  }
  estimates_stale_ = false;
  stale_ = true;  // the snapshot shows where the mesh is worst
}

bool Lane::due(double interval) const { return pace_.due(wallSeconds(), interval); }

bool Lane::wantsSnapshot(bool resting, double interval) const {
  if (broken() || !stale_) return false;
  if (!std::isfinite(solve_->measures().unshot_fraction)) return false;  // the last good one stays
  return resting || due(interval);
}

void Lane::refresh(bool resting, double interval) {
  if (wantsSnapshot(resting, interval)) {
    const double began = wallSeconds();
    try {
      snapshot_ = std::make_shared<const Snapshot>(solve_->snapshot());
      stale_ = false;
    } catch (...) {
      noteException();
    }
    pace_.made(began, wallSeconds());
  }
  refreshInsight(resting);
  if (facts_->diagnostics.size() != solve_->diagnostics().size() || facts_->plan != solve_->plan())
    learnFacts(facts_->options, facts_->load_seconds);
  if (!history_ || history_->size() != solve_->history().size())
    history_ = std::make_shared<const std::vector<HistoryEntry>>(solve_->history());
}

LaneState Lane::state(bool resting, bool paused) const {
  LaneState state;
  state.own_phase = phase(paused);
  state.facts = facts_;
  state.snapshot = snapshot_;
  state.history = history_;
  state.measures = solve_->measures();
  state.estimates = solve_->estimates();
  state.radius_lower = solve_->bounds().spectralRadiusLower();
  state.radius_upper = solve_->bounds().spectralRadiusUpper();
  state.bounces_under_way = !broken() && hasBounceWork();
  state.spare_work = resting && hasSpareWork();
  state.progress = active().progress();
  state.activity = solve_->activity();
  state.finer_mesh = finer_ != nullptr || wantsFinerMesh();
  state.kept_bytes = solve_->keptBytes();
  if (looking_on_) state.insight = looking_on_->shown();
  if (resting) state.gathering = gathering();
  if (resting) state.completing = completing();
  state.drawn = solve_->drawn();
  state.stopped_by = broken_.value_or(solve_->stoppedBy());
  return state;
}

}  // namespace unshot
