#include "session/live_solve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/clock.h"
#include "gl/context.h"
#include "scene/obj_reader.h"

namespace unshot {
namespace {

// Errors are estimated from so many places while the solve runs and when it rests.
constexpr std::size_t kPlacesInPassing = 128, kPlacesAtRest = 512, kPlacesAtOnce = 64;
constexpr double kEstimateShare = 0.05;
// An estimate passes over the whole mesh: on a larger one it would be felt as a pause.
constexpr std::size_t kMostElementsInPassing = 200'000;

// The exception in flight, worded for the person at the keyboard.
Error presentError() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorKind::kEnvironment, "there is not enough memory", {}, "fewer elements");
  } catch (const std::exception& error) {
    return Error(ErrorKind::kInternal, error.what());
  } catch (...) {
    return Error(ErrorKind::kInternal, "an unknown exception");
  }
}

std::shared_ptr<const SolveFacts> factsOf(const Solve& solve, double load_seconds) {
  auto facts = std::make_shared<SolveFacts>();
  const Scene& scene = solve.scene();
  const Mesh& mesh = solve.mesh();
  facts->scene_path = scene.path;
  facts->scene_name = scene.name;
  facts->options = solve.options();
  facts->mode = solve.modeKey();
  facts->form_factors = solve.formFactorsKey();
  facts->plan = solve.plan();
  facts->diagnostics = solve.diagnostics();
  facts->triangles = scene.triangle_count;
  facts->surfaces = mesh.surfaces.size();
  facts->patches = mesh.patch_count;
  facts->elements = mesh.element_count;
  facts->vertices = mesh.vertices.size();
  facts->load_seconds = load_seconds;
  facts->mesh_seconds = solve.seconds().mesh;
  return facts;
}

}  // namespace

bool isSuperseded(const Command& command, const Command& later) {
  const bool opens = std::holds_alternative<command::Open>(later);
  if (std::holds_alternative<command::Open>(command)) return opens;
  return std::holds_alternative<command::Restart>(command) &&
         (opens || std::holds_alternative<command::Restart>(later));
}

LiveSolve::LiveSolve(LiveSolveSetup setup) : setup_(std::move(setup)) {}

LiveSolve::~LiveSolve() {
  solve_.reset();  // its GL objects, while the context is still current
  if (setup_.gl) setup_.gl->release();
}

void LiveSolve::carryOut(const Command& command) {
  try {
    std::visit([this](const auto& c) { perform(c); }, command);
  } catch (const Cancelled&) {
  } catch (...) {
    noteException();
  }
  task_.clear();
  ++commands_;
  settle();
  publish();
}

void LiveSolve::step() {
  try {
    solve_->step();
    stale_ = estimates_stale_ = true;
    estimateInPassing();
  } catch (...) {
    noteException();
    broken_ = problem_->what();
  }
  if (running() && steps_left_ > 0 && --steps_left_ == 0) paused_ = true;
  settle();
  if (!running() || pace_.due(wallSeconds(), *setup_.interval)) publish();
}

bool LiveSolve::hasSpareWork() const {
  if (!solve_ || broken_ || running() || !task_.empty() || !hasLight()) return false;
  if (hasBounceWork()) return true;
  return !no_more_places_ && (estimates_stale_ || solve_->places() < kPlacesAtRest);
}

// Nothing shot yet says nothing.
bool LiveSolve::hasLight() const {
  return solve_->measures().shots > 0 && std::isfinite(solve_->measures().unshot_fraction);
}

bool LiveSolve::hasBounceWork() const {
  return hasLight() && !no_more_bounces_ && solve_->hasBouncesToWorkOut(complete_bounces_);
}

void LiveSolve::workOutBounces() {
  try {
    if (!solve_->workOutBounces(complete_bounces_)) return;
  } catch (...) {
    noteException();
    no_more_bounces_ = true;
  }
  stale_ = true;
  if (!hasBounceWork() || pace_.due(wallSeconds(), *setup_.interval)) publish();
}

void LiveSolve::spareWork() {
  if (hasBounceWork()) return workOutBounces();
  estimateFrom(std::min(kPlacesAtOnce, kPlacesAtRest - std::min(kPlacesAtRest, solve_->places())));
  publish();
}

// While it runs: as often as a small share of the solve's time allows.
void LiveSolve::estimateInPassing() {
  if (!running() || facts_->elements > kMostElementsInPassing) return;
  if (estimate_seconds_ > kEstimateShare * solve_->measures().seconds) return;
  estimateFrom(solve_->places() < kPlacesInPassing ? kPlacesInPassing / 8 : 0);
}

void LiveSolve::estimateFrom(std::size_t more_places) {
  const double began = wallSeconds();
  const std::size_t before = solve_->places();
  try {
    solve_->estimate(more_places);
    no_more_places_ = more_places > 0 && solve_->places() == before;
  } catch (...) {
    noteException();
    no_more_places_ = true;
  }
  estimate_seconds_ += wallSeconds() - began;
  estimates_stale_ = false;
  stale_ = true;  // the snapshot shows where the mesh is worst
}

void LiveSolve::perform(const command::Open& c) {
  announce("reading " + c.scene.filename().string());
  const double began = wallSeconds();
  Scene scene = readObj(c.scene, setup_.given_up);
  begin(std::move(scene), c.options, wallSeconds() - began);
}

void LiveSolve::perform(const command::Restart& c) {
  if (!solve_) throw Error(ErrorKind::kUsage, "there is no scene to solve yet", {}, "open one");
  begin(solve_->scene(), c.options, facts_->load_seconds);
}

void LiveSolve::perform(const command::Pause&) {
  if (!running()) return;
  paused_ = true;
  steps_left_ = 0;
}

void LiveSolve::perform(const command::Resume&) {
  paused_ = false;
  steps_left_ = 0;
}

void LiveSolve::perform(const command::Step& c) {
  if (!running() && phase() != SessionPhase::kPaused) return;
  paused_ = c.shots == 0 && steps_left_ == 0;
  steps_left_ += std::min(c.shots, std::numeric_limits<std::uint64_t>::max() - steps_left_);
}

void LiveSolve::perform(const command::SetMode& c) {
  usable().setMode(c.key);
  failure_noted_ = false;
  facts_ = factsOf(*solve_, facts_->load_seconds);
}

void LiveSolve::perform(const command::SetError& c) {
  usable().setError(c.error);
  facts_ = factsOf(*solve_, facts_->load_seconds);
}

void LiveSolve::perform(const command::CompleteBounces&) {
  usable();
  complete_bounces_ = true;
}

void LiveSolve::perform(const command::ShootAgain&) {
  usable().again();
  history_.reset();
  failure_noted_ = false;
  stale_ = estimates_stale_ = true;
  pace_ = {};
  ++epoch_;
}

SessionPhase LiveSolve::phase() const {
  if (!task_.empty()) return SessionPhase::kLoading;
  if (!solve_) return SessionPhase::kEmpty;
  if (broken_) return SessionPhase::kFailed;
  switch (solve_->state()) {
    case SolveState::kRunning:
      return paused_ ? SessionPhase::kPaused : SessionPhase::kRunning;
    case SolveState::kConverged:
      return SessionPhase::kConverged;
    case SolveState::kFailed:
      return SessionPhase::kFailed;
    default:
      return SessionPhase::kStopped;
  }
}

gl::Context& LiveSolve::context() {
  if (!setup_.gl) {
    throw Error(ErrorKind::kEnvironment, "there is no OpenGL context to draw hemicubes with", {},
                "the form factors 'closed-form'");
  }
  setup_.gl->makeCurrent();
  return *setup_.gl;
}

Solve& LiveSolve::usable() {
  if (!solve_) throw Error(ErrorKind::kUsage, "there is no scene to solve yet", {}, "open one");
  if (broken_) throw Error(ErrorKind::kUsage, "the solve has failed and cannot go on", {}, "restart it");
  return *solve_;
}

// The new solve takes the old one's place only when it stands and has its first snapshot.
void LiveSolve::begin(Scene scene, const SolveOptions& options, double load_seconds) {
  setup_.given_up.check();
  announce("meshing " + scene.path.filename().string());
  auto fresh = std::make_unique<Solve>(
      std::move(scene), options, [this]() -> gl::Context& { return context(); }, setup_.given_up);
  setup_.given_up.check();
  const double began = wallSeconds();
  auto first = std::make_shared<const Snapshot>(fresh->snapshot());
  const double ended = wallSeconds();
  facts_ = factsOf(*fresh, load_seconds);
  solve_ = std::move(fresh);
  snapshot_ = std::move(first);
  history_.reset();
  pace_.made(began, ended);
  broken_.reset();
  failure_noted_ = paused_ = stale_ = estimates_stale_ = false;
  estimate_seconds_ = 0;
  no_more_places_ = complete_bounces_ = no_more_bounces_ = false;
  steps_left_ = 0;
  ++epoch_;
}

void LiveSolve::announce(const std::string& task) {
  if (solve_) solve_->rest();
  task_ = task;
  publish();
}

// What follows from a phase, once it is known.
void LiveSolve::settle() {
  if (!solve_ || running()) return;
  solve_->rest();
  if (phase() != SessionPhase::kPaused) steps_left_ = 0;
  if (!broken_ && !failure_noted_ && solve_->state() == SolveState::kFailed) {
    failure_noted_ = true;
    note(*solve_->failure());
  }
}

void LiveSolve::note(Error problem) {
  ++problems_;
  problem_ = std::move(problem);
}

void LiveSolve::noteException() { note(presentError()); }

bool LiveSolve::wantsSnapshot() const {
  if (!solve_ || broken_ || !stale_ || !task_.empty()) return false;
  if (!std::isfinite(solve_->measures().unshot_fraction)) return false;  // the last good one stays
  return !running() || pace_.due(wallSeconds(), *setup_.interval);
}

void LiveSolve::makeSnapshot() {
  const double began = wallSeconds();
  try {
    snapshot_ = std::make_shared<const Snapshot>(solve_->snapshot());
    stale_ = false;
  } catch (...) {
    noteException();
  }
  pace_.made(began, wallSeconds());
}

void LiveSolve::publish() {
  if (wantsSnapshot()) makeSnapshot();
  if (solve_ && (!history_ || history_->size() != solve_->history().size()))
    history_ = std::make_shared<const std::vector<HistoryEntry>>(solve_->history());
  auto state = std::make_shared<SessionState>();
  ++version_;
  fill(*state);
  setup_.publish(std::move(state));
}

void LiveSolve::fill(SessionState& state) const {
  state.version = version_;
  state.epoch = epoch_;
  state.commands = commands_;
  state.phase = phase();
  state.task = task_;
  state.facts = facts_;
  state.snapshot = snapshot_;
  state.history = history_;
  state.problems = problems_;
  state.problem = problem_;
  if (!solve_) return;
  state.measures = solve_->measures();
  state.progress = solve_->progress();
  state.kept_bytes = solve_->keptBytes();
  state.drawn = solve_->drawn();
  state.estimates = solve_->estimates();
  state.radius_lower = solve_->bounds().spectralRadiusLower();
  state.radius_upper = solve_->bounds().spectralRadiusUpper();
  state.bounces_under_way = !broken_ && hasBounceWork();
  state.stopped_by = broken_.value_or(solve_->stoppedBy());
}

}  // namespace unshot
