#include "session/solve.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "formfactor/closure.h"
#include "formfactor/methods.h"
#include "formfactor/sky.h"
#include "gl/context.h"
#include "scene/scene_hash.h"
#include "session/preparation.h"
#include "session/saved_solve.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

// Unshot power over emitted power that a direct solution leaves at most.
constexpr double kSolved = 1e-10;
// Shots taken at once along columns at hand: one for so many before.
constexpr std::uint64_t kShotsBeforeMore = 200;
// And no more than go over so many receivers, some milliseconds.
constexpr std::uint64_t kReceiversAtOnce = 1'000'000;
// Of them so many along columns that have to be computed.
constexpr std::uint64_t kColumnsAtOnce = 2;
// A check of the energy goes over all receivers, which a step may not.
constexpr std::size_t kRecordsToACheck = 8;
// Patches whose columns take a minute or two; with more, limits of time come before the first bounce.
constexpr std::uint32_t kMostForGmres = 20'000;

void checkError(double error) {
  if (error > 0 && error < 1) return;
  throw Error(ErrorKind::kUsage, "the error asked for must be above 0 and below 1", {}, "--error 0.01");
}

std::vector<glm::dvec3> perPatch(const Mesh& mesh, glm::dvec3 Side::*member) {
  std::vector<glm::dvec3> out;
  out.reserve(mesh.patch_count);
  for (const std::uint32_t side : mesh.patch_side) out.push_back(mesh.sides[side].*member);
  return out;
}

}  // namespace

void Solve::Impl::prepare(const std::function<gl::Context&()>& gl, const CancelToken& cancel,
                          std::shared_ptr<SavedSolve> saved) {
  checkError(options.error);
  if (saved) {
    if (saved->scene_hash != sceneHash(scene))
      throw Error(ErrorKind::kInput, "was saved from another scene than " + scene.path.string(),
                  saved->path.string(), "the scene as it was then, or a new start");
    if (scene.materials != saved->mesh->materials) {
      scene.hash_as_read = saved->scene_hash;
      scene.materials = saved->mesh->materials;
    }
    options = saved->options(std::move(options));
  }
  setUp(gl, cancel);
  if (saved) restore(*saved);
  begin();
  if (saved) takeUp(*saved);
  if (saved) mesh_error = saved->error;
  measure();
  if (!saved) history.push_back({measures});
}

// All that stands before the first shot.
void Solve::Impl::setUp(const std::function<gl::Context&()>& gl, const CancelToken& cancel) {
  cpu_start = cpuSeconds();
  mesh_error = options.mesh_error.value_or(options.error);
  Preparation prepared = unshot::prepare(scene, options, cancel);
  mesh = std::move(prepared.mesh);
  form_factors_key = std::move(prepared.form_factors);
  plan = std::move(prepared.plan);
  diagnostics = std::move(prepared.diagnostics);
  seconds.mesh = prepared.mesh_seconds;
  seconds.plan = prepared.plan_seconds;
  sky = prepared.sky;
  if (!options.final_gather) options.final_gather = prepared.gathers;
  solve_start = wallSeconds();

  cancel.check();
  makeTransport(gl, cancel);
  cancel.check();
  std::vector<glm::dvec3> emission = perPatch(*mesh, &Side::emission),
                          reflectance = perPatch(*mesh, &Side::reflectance);
  if (transport->patchCount() > mesh->patch_count) {
    emission.push_back(sky);
    reflectance.emplace_back(0.0);
  }
  state = std::make_unique<RadiosityState>(*transport, std::move(emission), std::move(reflectance));
  cancel.check();
  ambient = std::make_unique<AmbientTerm>(mesh->patch_count, mesh->patch_air);
  budget = std::make_unique<ErrorBudget>(*mesh, *transport, *state, options.kept_bytes / options.sharers / 4,
                                         form_factors_key != "closed-form" || !nothingCanOcclude(*mesh),
                                         options.seed);
  const bool fewer_channels = std::any_of(
      plan.begin(), plan.end(), [](const PlanDecision& d) { return d.key == plan_keys::kChannels; });
  state->allowFewerChannels(fewer_channels);
  budget->allowFewerChannels(fewer_channels);
  transport->watchColumns([this](std::uint32_t q, const Column& column) {
    // What the sky shines on need not see each other.
    if (q < mesh->patch_count) ambient->sees(q, column, transport->receivers());
    budget->columnComputed(q, column);
    if (column.escape > 0) noteOpening(column.escape);
  });
  planClosure(cancel);
  if (mesh->for_error && transport->receivers().kind == ReceiverKind::kVertices && !options.bounces)
    local_pass = std::make_unique<LocalPass>(*mesh, transport->receivers(), form_factors_key != "closed-form",
                                             workers, std::move(prepared.rays));
  planGather();
  bounces_of_light = std::make_unique<Bounces>(mesh, *transport, *state);
  if (prepared.solved) beginWith(std::move(*prepared.solved));
}

// Its columns are there in any case; what is asked of a mode in particular, that mode does.
void Solve::Impl::beginWith(SolvedAtOnce solved) {
  for (std::uint32_t q = 0; q < mesh->patch_count; ++q) transport->restore(q, std::move(solved.columns[q]));
  rows_before = transport->computed() - mesh->patch_count;
  budget->offerPlaces(std::move(solved.places));
  // Where much is reflected, rows are closed first.
  begun_solved = options.mode == "auto" && !options.max_shots && !options.bounces && !high_gain &&
                 state->setValues(std::move(solved.values));
  if (!begun_solved) return;
  closure_pending = false;  // the trial has shown that its rows are good enough
  if (local_pass) local_pass->restore(std::move(solved.local_irradiance));
}

void Solve::Impl::begin() {
  chooseMode(options.mode);
  if (state->emittedPower() <= 0) endWithoutLight();
}

void Solve::Impl::endWithoutLight() {
  measures.unshot_fraction = 0;
  stop(SolveState::kConverged, "no light");
}

void Solve::Impl::makeTransport(const std::function<gl::Context&()>& gl, const CancelToken& cancel) {
  const FormFactorMethodRow& row = findChoice(formFactorMethods(), form_factors_key, "form-factor method");
  FormFactorSetup setup;
  setup.mesh = mesh.get();
  setup.cancel = cancel;
  setup.seed = options.seed;
  setup.workers = workers;
  setup.hemicube_resolution = options.hemicube_resolution;
  setup.hemicube_drawing = options.hemicube_drawing;
  setup.gl = [&gl]() -> gl::Context& {
    gl::Context& context = gl();
    context.makeCurrent();
    return context;
  };
  const double cpu_before_setup = cpuSeconds();
  const auto receivers = std::make_shared<const Receivers>(makeReceivers(*mesh, row.receivers, cancel));
  if (row.receivers == ReceiverKind::kVertices) setup.receivers = receivers;
  std::unique_ptr<FormFactorMethod> method = row.make(setup);
  if (!method->note().empty())
    diagnostics.push_back({Severity::kNote, "form-factor-note", method->note(), {}, {}});
  if (options.wrap_form_factors) method = options.wrap_form_factors(std::move(method));
  cancel.check();
  cpu_setup = cpuSeconds() - cpu_before_setup;
  std::vector<double> areas = mesh->patch_area;
  if (sky != glm::dvec3(0.0)) {
    SkySource source = lookAtSky(*mesh, *receivers, options.seed, cancel);
    if (source.area > 0) {
      areas.push_back(source.area);
      method = withSky(std::move(method), mesh->patch_count, std::move(source.column));
    } else {
      sky = glm::dvec3(0.0);
      diagnostics.push_back({Severity::kNote, "sky-unseen", "no surface sees any of the sky", {}, {}});
    }
  }
  transport = std::make_unique<Transport>(std::move(method), *receivers, std::move(areas),
                                          options.kept_bytes / options.sharers);
  transport->allowDrafts(options.draft_first && !options.bounces);
}

void Solve::Impl::chooseMode(const std::string& key) {
  // Where much is reflected, shot after shot takes as many bounces as light does. It needs all columns first.
  const bool together = options.soonest && high_gain && mesh->patch_count <= kMostForGmres &&
                        leavesOut(options.do_anyway, plan_keys::kShots);
  const std::string soonest = together ? "gmres" : "southwell";
  const std::string chosen = key != "auto" ? key : options.bounces ? "jacobi" : soonest;
  if (options.bounces && chosen != "jacobi") {
    throw Error(ErrorKind::kUsage,
                "light of a number of bounces takes the mode 'jacobi', not '" + chosen + "'", {},
                "no --mode, or no --bounces");
  }
  const IterationModeRow& row = findChoice(iterationModes(), chosen, "iteration mode");
  const std::string reason = row.unavailable(modeSetup(mesh->element_count, state->reflectance()));
  if (!reason.empty()) {
    throw Error(ErrorKind::kEnvironment, "the mode '" + chosen + "' is not for this scene: " + reason);
  }
  mode_row = &row;
  if (!row.drafts) transport->allowDrafts(false);
  mode.reset();
  mode_key = chosen;
  options.mode = key;
  if (key != "auto" || chosen != "gmres") return;
  const double gain = reflectionGain(*mesh);
  decide(withoutAnyShots(mesh->patch_count, std::isfinite(gain) ? gain / (1 + gain) : 1, options.error));
}

// In the place of what was said of the same before.
void Solve::Impl::decide(PlanDecision decision) {
  std::erase_if(plan, [&](const PlanDecision& d) { return d.key == decision.key; });
  plan.push_back(std::move(decision));
}

void Solve::Impl::wakeClocks() {
  if (!resting) return;
  solve_start += wallSeconds() - measured_wall;
  cpu_start += cpuSeconds() - measured_cpu;
  resting = false;
}

void Solve::Impl::measure() {
  measured_wall = wallSeconds();
  measured_cpu = cpuSeconds();
  measures.seconds = measured_wall - solve_start;
  measures.cpu_seconds = measured_cpu - cpu_start - cpu_setup;
  measures.rows = transport->computed() - rows_before;
  measures.true_error = known_solution.errorOf(*state, *transport);
  measures.drafts = transport->draftCount();
  measures.refined = transport->refined();
  const double emitted = state->emittedPower();
  if (!std::isfinite(emitted)) {
    measures.unshot_fraction = emitted - emitted;  // not a number, rather than a share of infinity
  } else if (emitted > 0) {
    measures.unshot_fraction = state->unshotPower() / emitted;
    measures.bounds = budget->update(measures.shots);
  }
  seconds.solve = measures.seconds;
  seconds.cpu_solve = measures.cpu_seconds;
}

// What the mode `direct` has found; another mode's state is exact to no known digit.
void Solve::Impl::learnSolution() {
  if (mode_key != "direct" || known_solution.known(*transport)) return;
  if (state->unshotPower() <= kSolved * state->emittedPower()) known_solution.learn(*state, *transport);
}

// A curve needs no more points than a plot has pixels: each is a hundredth further than the last.
void Solve::Impl::record() {
  const auto steps = [](const Measures& m) { return m.shots + m.rows; };
  const std::uint64_t last = steps(history.back().measures), now = steps(measures);
  const bool ended = progress_state != SolveState::kRunning;
  if ((ended && now > last) || now >= last + std::max<std::uint64_t>(1, last / 100)) {
    history.push_back({measures});
    if (history.size() % kRecordsToACheck == 0) checkEnergy();
  }
  if (ended) checkEnergy();
}

void Solve::Impl::refine() {
  mode.reset();
  drafts.step(*transport, *state);
}

// A step of the mode, or some where each is a shot along a column at hand or soon computed: looking at what
// it leaves takes as long. A mode that cannot go on ends the solve as failed, with what it has. Returns false
// where nothing is left to shoot.
bool Solve::Impl::iterate(std::uint64_t most_shots) {
  if (!mode) mode = options.bounces ? makeBounces(*options.bounces) : mode_row->make();
  if (options.max_shots && *options.max_shots > measures.shots)
    most_shots = std::min(most_shots, *options.max_shots - measures.shots);
  most_shots = std::min(most_shots, measures.shots / kShotsBeforeMore);
  most_shots =
      std::min(most_shots, kReceiversAtOnce / std::max<std::uint64_t>(1, transport->receiverCount()));
  const std::uint64_t computed = transport->computed();
  const std::uint64_t shots_before = measures.shots;
  try {
    for (;;) {
      const std::uint64_t computed_before = transport->computed();
      const std::optional<std::size_t> used = mode->step(*state, *transport);
      if (!used && measures.shots == shots_before) return false;
      measures.shots += used.value_or(0);
      if (transport->computed() == computed_before) shots_at_hand += used.value_or(0);
      if (used != 1 || measures.shots - shots_before >= most_shots ||
          transport->computed() >= computed + kColumnsAtOnce)
        return true;
    }
  } catch (const IterationFailure& problem) {
    mode_failed = true;
    fail(problem.kind(), problem.what(), problem.advice());
    return true;
  }
}

Solve::Solve(Scene scene, SolveOptions options, std::function<gl::Context&()> gl, const CancelToken& cancel,
             std::shared_ptr<SavedSolve> saved)
    : impl_(std::make_unique<Impl>(std::move(scene), std::move(options))) {
  impl_->prepare(gl, cancel, std::move(saved));
}

Solve::~Solve() = default;

// What a step throws, such as a driver that gives up or memory that is used up, ends the solve with what was
// shot before: columns are computed before anything is shot along them.
void Solve::step(std::uint64_t most_shots) {
  Impl& s = *impl_;
  if (s.progress_state != SolveState::kRunning) return;
  s.wakeClocks();
  const auto fail = [&s](const Error& error) {
    s.mode.reset();
    // What was reached can be shown and saved without them, which needs memory too.
    if (error.kind() == ErrorKind::kEnvironment) s.transport->release();
    s.fail(error.kind(), error.what(), error.advice());
  };
  try {
    s.advance(most_shots);
  } catch (const std::bad_alloc&) {
    s.transport->release();  // and so does the message
    fail(presentError());
  } catch (...) {
    fail(presentError());
  }
  s.sayIdle();
}

void Solve::Impl::advance(std::uint64_t most_shots) {
  if (!hand_order.empty()) return sendHanded();
  if (finished_by) return sharpen();
  if (begun_solved && measures.shots == 0) return finishBegun();
  bool nothing_left = false;
  bool refined = true;
  if (computeIdle()) {
    refined = false;
  } else if (closeRows()) {
    // Nothing else in this step: what it has brought is looked at first.
  } else if (drafts.due(*transport, measures.solverBound() <= target())) {
    refine();
  } else if ((lacksBound() || closureIsUrgent()) && completeColumns()) {
    refined = false;
  } else if (takeLeap() || iterate(most_shots)) {
    refined = false;
  } else if (closureIsDue() && completeColumns()) {
    refined = false;
  } else {
    nothing_left = measures.drafts == 0 && !closureIsDue();
    refined = !nothing_left;
    if (measures.drafts > 0) refine();
  }
  learnSolution();
  measure();
  if (refined) stagnation.restart(measures);  // a better column brings unshot light of its own
  if (progress_state == SolveState::kRunning) checkLimits();
  if (progress_state == SolveState::kLimit || nothing_left) measures.bounds = budget->sharpen();
  if (progress_state == SolveState::kRunning && nothing_left && !finished_by) {
    if (options.bounces && !state->onlyRoundingUnshot()) {
      stop(SolveState::kConverged, "bounces");
    } else {
      finish("nothing unshot");
    }
  }
  if (progress_state == SolveState::kRunning && !finished_by) checkStagnation();
  noteMissingRoom();
  record();
}

void Solve::again() {
  Impl& s = *impl_;
  s.state->reset();
  s.begun_solved = false;
  s.hand_order.clear();
  s.budget->restart();
  s.mode.reset();
  s.shared.forgetDirect();
  s.finished_by.reset();
  if (s.local_pass) s.local_pass->forget();
  if (s.final_gather) s.final_gather->forget();
  s.failure.reset();
  s.mode_failed = s.resting = false;
  s.drafts = {};
  s.leap = {};
  s.shots_at_hand = 0;
  s.rows_before = s.transport->computed();
  s.measures.shots = 0;
  s.solve_start = wallSeconds();
  s.cpu_start = cpuSeconds() - s.cpu_setup;
  s.stop(SolveState::kRunning, {});
  if (s.state->emittedPower() <= 0) s.endWithoutLight();
  s.measure();
  s.history.assign(1, {s.measures});
  s.stagnation.restart(s.measures);
}

void Solve::setMode(const std::string& key) {
  Impl& s = *impl_;
  std::erase_if(s.plan, [](const PlanDecision& d) { return d.key == plan_keys::kShots; });
  s.chooseMode(key);
  if (s.mode_failed && s.progress_state == SolveState::kFailed) {
    s.failure.reset();
    s.stop(SolveState::kRunning, {});
  }
  s.mode_failed = false;
  s.stagnation.restart(s.measures);
}

void Solve::setError(double error) {
  checkError(error);
  Impl& s = *impl_;
  s.options.error = error;
  s.finished_by.reset();
  if (s.final_gather) s.final_gather->abandon();
  if (s.stopped_by == "no light") return;
  if (s.progress_state == SolveState::kConverged) {
    s.stop(SolveState::kRunning, {});
    s.stagnation.restart(s.measures);
  } else if (s.progress_state == SolveState::kLimit && s.measures.solverBound() <= s.target()) {
    s.stop(SolveState::kRunning, {});
  }
  if (s.progress_state != SolveState::kRunning) return;
  s.checkLimits();
  s.record();
}

const ErrorEstimates& Solve::estimate(std::size_t more_places) {
  Impl& s = *impl_;
  const double cpu_began = cpuSeconds();
  rest();
  const MeshField shown = s.shownField();
  s.budget->estimate(more_places, shown);
  s.noteMissedError();
  s.shared.setResidual(*s.mesh, s.budget->patchResiduals(shown));
  s.seconds.cpu_solve += cpuSeconds() - cpu_began;
  return s.budget->estimates();
}

bool Solve::workOutBounces(bool compute) {
  Impl& s = *impl_;
  const double cpu_began = cpuSeconds();
  rest();
  const bool news = s.bounces_of_light->advance(compute);
  s.measures.rows = s.transport->computed() - s.rows_before;
  // All columns are there now, which bounds and the spectral radius may have waited for.
  if (news && !s.bounces_of_light->hasWork(compute))
    s.measures.bounds = SolverBounds::tighter(s.measures.bounds, s.budget->sharpen());
  s.seconds.cpu_solve += cpuSeconds() - cpu_began;
  return news;
}

void Solve::forgetPlaces() { impl_->budget->forgetPlaces(); }

void Solve::rest() { impl_->resting = true; }

void Solve::interrupt() {
  if (impl_->progress_state != SolveState::kRunning) return;
  if (impl_->final_gather) impl_->final_gather->finish();
  impl_->stop(SolveState::kInterrupted, "interrupted");
}

}  // namespace unshot
