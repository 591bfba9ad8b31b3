// How a solve ends: the error reached, limits, stagnation, failures; and the local pass before a good end.
#include <cmath>

#include "base/text.h"
#include "session/solve_impl.h"

namespace unshot {
namespace {

// Of the error asked for, where it is that of the whole: the rest is the mesh's and the form factors'.
constexpr double kSolverShare = 0.4;
// Of that share: what may be unshot where there is no bound yet. Shots alone would ask for the columns that a
// bound needs long after they have nothing left to do.
constexpr double kLittleUnshot = 0.25;
// Of the power that is accounted for: rounding leaves 1e-9 at most (10,000 scenes of the property tests).
constexpr double kMostDrift = 1e-6;
// Of that share: what the last bounces that are left out may leave too dark (two sweeps leave about a ninth).
constexpr double kWorthSweeping = 0.1;
// What asks for a word is surely above the error asked for, and by estimate so many times as large.
constexpr double kFarAbove = 3;
// What final gathering is kept of a limited time, over what some looks let expect, and at most.
constexpr double kGatherMargin = 1.15, kMostOfTime = 0.7;

}  // namespace

double Solve::Impl::target() const { return mesh->for_error ? kSolverShare * options.error : options.error; }

void Solve::Impl::stop(SolveState how, std::string why) {
  progress_state = how;
  stopped_by = std::move(why);
}

void Solve::Impl::fail(ErrorKind kind, std::string why, std::string advice) {
  failure.emplace(kind, "the solve failed: " + why, scene.path.string(), std::move(advice));
  stop(SolveState::kFailed, std::move(why));
}

// Whether final gathering follows, and how much of a limited time it is kept.
void Solve::Impl::planGather() {
  if (!options.final_gather.value_or(false) || options.bounces || options.max_shots) return;
  final_gather = std::make_unique<FinalGather>(*mesh, workers, options.seed);
  if (!options.max_seconds) return;
  const double most = kMostOfTime * *options.max_seconds;
  const GatherSeconds expected = final_gather->expectedSeconds();
  const double least = kGatherMargin * (expected.bounces + expected.round);
  gather_seconds =
      std::min(most, kGatherMargin * (expected.bounces + FinalGather::kExpectedRounds * expected.round));
  if (least <= most) return;
  final_gather.reset();
  diagnostics.push_back(
      {Severity::kNote,
       "not-gathered",
       "light is shown as hemicubes have it: final gathering, which is nearer to the truth, "
       "takes about " +
           figureText(least) + " s",
       {},
       "--max-seconds " + figureText(std::ceil(least / kMostOfTime))});
  gather_seconds = 0;
}

// Converged, but for what follows where the mesh was made for the error asked for.
void Solve::Impl::finish(std::string why) {
  // A bound there is only where light dies out; then what lies below zero is the error that it allows.
  if (measures.solverBound() == kNoBound && !isLight(*state)) return failWithoutSolution();
  finishAs(SolveState::kConverged, std::move(why));
}

void Solve::Impl::finishAs(SolveState how, std::string why) {
  finishes_as = how;
  if (final_gather) {
    finished_by = std::move(why);
    const MeshField direct = makeField(*mesh, transport->receivers(), state->direct());
    return final_gather->begin(*state, makeField(*mesh, transport->receivers(), shownIrradiance()), direct);
  }
  if (how != SolveState::kConverged) return stop(how, std::move(why));
  last_sweeps = {};
  leap.abandon();
  if (endsNearTheTruth() && measures.solverBound() > kWorthSweeping * target()) {
    if (canLeapBy(budget->matrix())) {
      leap.begin(budget->matrix(), *state, *transport);
    } else {
      last_sweeps.begin();
    }
  }
  local_passes_left = local_pass ? LocalPass::kPasses : 0;
  if (local_pass) local_pass->abandon();
  if (!sweeps() && local_passes_left == 0) return stop(SolveState::kConverged, std::move(why));
  finished_by = std::move(why);
}

// Begun with the light of a trial, which leaves nothing to be done where its bound says so.
void Solve::Impl::finishBegun() {
  begun_solved = false;
  measure();
  measures.bounds = SolverBounds::tighter(measures.bounds, budget->sharpen());
  if (measures.solverBound() <= target()) stop(SolveState::kConverged, boundReached());
  record();
}

// Goes on with the last sweeps and the local pass, which bring the good end nearer to the truth but are no
// condition of it.
void Solve::Impl::sharpen() {
  if (final_gather) return sharpenByGather();
  const bool sweeping = sweeps();
  const SolverBounds reached_with = measures.bounds;  // sharpened
  if (sweeping) {
    measures.shots +=
        leap.running() ? leap.advance(*state, *transport) : last_sweeps.advance(*state, *transport);
  } else if (local_pass) {
    if (!local_pass->running()) {
      const bool first = local_passes_left-- == LocalPass::kPasses;
      local_pass->begin(
          *state, makeField(*mesh, transport->receivers(), first ? state->irradiance() : shownIrradiance()));
    }
    local_pass->advance(*transport);
  }
  measure();
  const bool out_of_time = options.max_seconds && measures.seconds >= *options.max_seconds;
  // Sweeps change the state, and what bounds its error.
  if (!sweeping) {
    measures.bounds = SolverBounds::tighter(measures.bounds, reached_with);
  } else if (!sweeps() || out_of_time) {
    measures.bounds = budget->sharpen();
  }
  const bool passing = local_passes_left > 0 || (local_pass && local_pass->running());
  if ((!sweeps() && !passing) || out_of_time)
    stop(SolveState::kConverged, *std::exchange(finished_by, std::nullopt));
}

void Solve::Impl::sharpenByGather() {
  const SolverBounds reached_with = measures.bounds;
  final_gather->advance();
  measure();
  measures.bounds = SolverBounds::tighter(measures.bounds, reached_with);
  if (options.max_seconds && measures.seconds >= *options.max_seconds) final_gather->finish();
  if (final_gather->running()) return;
  if (finishes_as == SolveState::kLimit) measures.bounds = budget->sharpen();
  stop(finishes_as, *std::exchange(finished_by, std::nullopt));
}

bool Solve::Impl::lacksBound() const {
  return !options.bounces && measures.solverBound() >= kNoBound &&
         measures.unshot_fraction < kLittleUnshot * target();
}

// Computes a column that no shot has asked for yet; false where none is left that light could take, or that
// closing rows needs.
bool Solve::Impl::completeColumns() {
  for (; next_column < transport->patchCount(); ++next_column) {
    const bool black = state->reflectance()[next_column] == glm::dvec3(0.0);
    if (transport->quality(next_column) || (black && !closureIsDue())) continue;
    transport->column(next_column++);
    return true;
  }
  return false;
}

// Whether the error asked for is reached, held against the bound as it is at its sharpest (which may be one
// per patch where the last was for the total).
bool Solve::Impl::reached() {
  if (measures.solverBound() > target() || measures.drafts > 0 || closureIsDue()) return false;
  measures.bounds = SolverBounds::tighter(measures.bounds, budget->sharpen());
  return measures.solverBound() <= target();
}

// Which of the bounds it is.
std::string Solve::Impl::boundReached() const {
  return measures.bounds.upper < kNoBound ? "solver_upper" : "solver_total_upper";
}

void Solve::Impl::checkLimits() {
  if (!std::isfinite(measures.unshot_fraction)) {
    fail(ErrorKind::kInternal, "a value is no longer finite", "another --mode or --form-factors");
  } else if (!options.bounces && reached()) {
    finish(boundReached());
  } else if (options.max_shots && measures.shots >= *options.max_shots) {
    stop(SolveState::kLimit, "max_shots");
  } else if (options.max_seconds && measures.seconds >= *options.max_seconds - gather_seconds) {
    finishAs(SolveState::kLimit, "max_seconds");
  }
}

void Solve::Impl::checkStagnation() {
  const auto hopeless = [this] { return (closureIsDue() && !closure_hurries) || nothingDiesOut(*state); };
  if (options.bounces || !stagnation.found(measures, mesh->patch_count, hopeless)) return;
  if (closureIsDue() && !closure_hurries) {
    // Rows that sum to more than 1 may be all that keeps it up.
    closure_hurries = true;
  } else if (nothingDiesOut(*state)) {
    failWithoutSolution();
  } else {
    fail(ErrorKind::kInternal, "stagnation: the unshot power does not fall",
         "another --mode or --form-factors");
  }
}

// Whatever was shot, all that was emitted is absorbed, escaped, unshot or a closure defect, to rounding: what
// is missing shows a step that went wrong.
void Solve::Impl::checkEnergy() {
  const EnergyBalance energy = energyOf(*transport, *state);
  if (failure || !(energy.emitted > 0) || std::abs(energy.residual()) <= kMostDrift * energy.size()) return;
  fail(ErrorKind::kInternal,
       "energy is not conserved: " + figureText(100 * energy.residual() / energy.emitted) +
           " % of what was emitted is unaccounted for",
       "another --mode or --form-factors, and please report it with the scene");
}

void Solve::Impl::failWithoutSolution() {
  fail(
      ErrorKind::kInput,
      "no finite solution: the walls that the light reaches reflect all of it (reflectance 1) and let none "
      "out, so it never dies out",
      "a reflectance (Kd) below 1 for some wall, or --bounces N (or --max-shots N) for the light of a number "
      "of bounces");
}

// Once, when the first column finds no room.
void Solve::Impl::noteMissingRoom() {
  if (room_noted || transport->missingRoom() == 0) return;
  room_noted = true;
  const auto megabytes = [](std::size_t bytes) {
    return std::to_string(static_cast<std::size_t>(std::ceil(static_cast<double>(bytes) / 1e6)));
  };
  const std::size_t needed = options.sharers * transport->missingRoom();
  const bool other_mode = !options.bounces && mode_key != "kept-first";
  diagnostics.push_back({Severity::kWarning,
                         "form-factors-not-kept",
                         "the form factors take about " + megabytes(needed) + " MB and may take " +
                             megabytes(options.kept_bytes) +
                             " MB: those beyond are computed again whenever they are needed",
                         {},
                         "--keep " + megabytes(needed * 11 / 10) + ", fewer --elements" +
                             (other_mode ? ", or the mode kept-first" : "")});
}

// Whether the mesh was to be as fine as the error asks for and is far from it.
bool Solve::Impl::missesError() const {
  const ErrorEstimate& estimate = budget->estimates().total;
  return mesh->for_error && progress_state == SolveState::kConverged && estimate.low > options.error &&
         estimate.value >= kFarAbove * options.error;
}

// Once.
void Solve::Impl::noteMissedError() {
  if (error_noted || !missesError()) return;
  error_noted = true;
  const ErrorEstimate& estimate = budget->estimates().total;
  const auto percent = [](double x) { return figureText(100 * x) + " %"; };
  diagnostics.push_back({Severity::kWarning,
                         "error-missed",
                         "the error is estimated to be " + percent(estimate.value) + " (" +
                             percent(estimate.low) + " to " + percent(estimate.high) + "), and " +
                             percent(options.error) +
                             " was asked for: some light changes faster than the mesh",
                         {},
                         "a smaller --error; for lamps close to a wall, --emit front or many --elements"});
}

}  // namespace unshot
