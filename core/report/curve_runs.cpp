#include "report/curve_runs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "base/clock.h"
#include "base/text.h"
#include "solver/modes.h"

namespace unshot {
namespace {

// Neighbouring points of a curve: 24 a decade.
const double kFurther = std::pow(10.0, 1.0 / 24);
// Total errors are measured as often as this.
const double kFurtherTotal = std::pow(10.0, 1.0 / 8);
// Below this solver error the total one changes no more.
constexpr double kLeastSolver = 1e-3;
// A dense factorisation of up to so many operations is quick (some 20 s).
constexpr double kQuickFactorisation = 1e11;
constexpr double kExactError = 1e-10;
// What may be left unshot of an exact solution: far below every error that is measured with it.
constexpr double kExactUnshot = 1e-8;

bool further(double now, double last, double factor) { return now > last * factor; }

}  // namespace

/// Busy and wall time of a solve that is stepped through it.
struct CurveRuns::Clock {
  const ColumnStore& columns;
  double cpu = 0, wall = 0;  // without what is charged

  Clock(const ColumnStore& store, const Solve& solve)
      : columns(store),
        cpu(solve.measures().cpu_seconds),
        wall(solve.seconds().mesh + solve.seconds().plan) {}

  void step(Solve& solve) {
    const double wall_before = wallSeconds(), cpu_before = cpuSeconds();
    solve.step();
    cpu += cpuSeconds() - cpu_before;
    wall += wallSeconds() - wall_before;
  }
  double cpuNow() const { return cpu + columns.charged().cpu_seconds; }
  double wallNow() const { return wall + columns.charged().seconds; }
  double wallBesideFormFactors() const {
    return wall - (columns.spent().seconds - columns.charged().seconds);
  }
};

CurveRuns::CurveRuns(const Scene& scene, SolveOptions options, std::function<gl::Context&()> gl)
    : scene_(scene), options_(std::move(options)), gl_(std::move(gl)), columns_(options_.kept_bytes) {
  options_.max_seconds.reset();
  options_.max_shots.reset();
  options_.wrap_form_factors = [this](std::unique_ptr<FormFactorMethod> method) {
    return columns_.wrap(std::move(method));
  };
}

std::unique_ptr<Solve> CurveRuns::begin(const std::string& mode, double error) {
  SolveOptions options = options_;
  options.mode = mode;
  options.error = error;
  auto solve = std::make_unique<Solve>(scene_, std::move(options), gl_);
  if (!reflectance_.empty()) return solve;
  const Mesh& mesh = solve->mesh();
  for (const std::uint32_t side : mesh.patch_side) reflectance_.push_back(mesh.sides[side].reflectance);
  figures_ = {solve->formFactorsKey(), solve->plan(),    solve->diagnostics(), mesh.surfaces.size(),
              mesh.element_count,      mesh.patch_count, mesh.vertices.size()};
  return solve;
}

std::string CurveRuns::unavailable(const std::string& mode) const {
  return findChoice(iterationModes(), mode, "iteration mode")
      .unavailable(modeSetup(figures_.elements, reflectance_));
}

ExactSolution CurveRuns::solveExactly(double max_seconds, const RunWatch& watch) {
  const double began = wallSeconds();
  ExactSolution exact;
  std::unique_ptr<Solve> solve = begin("gmres", kExactError);
  if (solve->stoppedBy() == "no light") {
    throw Error(ErrorKind::kInput, "the scene has no light, so there is no error to measure",
                scene_.path.string(), "a material with Ke above 0");
  }
  const ModeSetup setup = modeSetup(figures_.elements, reflectance_);
  const double operations = setup.channels * std::pow(static_cast<double>(setup.patches), 3);
  exact.mode = "gmres";
  if (operations <= kQuickFactorisation && unavailable("direct").empty()) {
    solve->setMode("direct");
    exact.mode = "direct";
  }
  while (solve->state() == SolveState::kRunning && wallSeconds() - began < max_seconds) {
    solve->step();
    const double unshot = std::max(solve->measures().unshot_fraction, kExactUnshot / 10);
    const double done = std::log(unshot) / std::log(kExactUnshot / 10);
    if (!watch(std::clamp(std::isfinite(done) ? done : 0.0, 0.0, 1.0))) {
      exact.interrupted = true;
      exact.why_not = "interrupted";
      return exact;
    }
  }
  exact.seconds = wallSeconds() - began;
  exact.unshot_fraction = solve->measures().unshot_fraction;
  const std::optional<Error>& failure = solve->failure();
  if (failure && failure->kind() == ErrorKind::kInput) throw *failure;
  if (exact.unshot_fraction <= kExactUnshot) {
    exact.radiosity = solve->patchRadiosity();
  } else if (failure) {
    exact.why_not = exact.mode + " failed: " + failure->what();
  } else {
    exact.why_not = exact.mode + " left " + percentText(exact.unshot_fraction) + " unshot after " +
                    durationText(exact.seconds);
  }
  if (exact.radiosity.empty()) options_.draft_first = false;
  return exact;
}

namespace {

/// Chooses which states of a run become points of its curve.
class PointPicker {
 public:
  PointPicker(ModeCurve& curve, std::span<const glm::dvec3> exact,
              const std::function<TotalError(const Solve&)>& total_error)
      : curve_(curve), exact_(exact), total_error_(total_error) {}

  void see(const Solve& solve, std::uint64_t step, double cpu, double wall) {
    curve_.drafts = curve_.drafts || solve.measures().drafts > 0;
    CurvePoint now = pointOf(solve, step, cpu, wall);
    const bool ended = solve.state() != SolveState::kRunning;
    if (curve_.points.empty() || ended || isFurther(now, curve_.points.back())) {
      // Where an error jumps, the state just before it is a point too.
      const bool jumped = passed_ && curve_.points.back().step < passed_->step && now.solver &&
                          passed_->solver->nrmse > kFurther * now.solver->nrmse;
      if (jumped) push(*passed_);
      if (ended || curve_.points.empty() || isFurtherTotal(now)) measureTotal(solve, now);
      push(now);
    }
    passed_ = std::move(now);
  }

  /// The last state becomes a point whatever it is.
  void end(const Solve& solve) {
    if (!passed_) return;
    if (curve_.points.back().step < passed_->step) push(*passed_);
    if (!curve_.points.back().total_error) measureTotal(solve, curve_.points.back());
  }

 private:
  CurvePoint pointOf(const Solve& solve, std::uint64_t step, double cpu, double wall) const {
    const Measures& m = solve.measures();
    CurvePoint point;
    point.step = step;
    point.shots = m.shots;
    point.rows = m.rows;
    point.cpu_seconds = cpu;
    point.seconds = wall;
    point.unshot_fraction = m.unshot_fraction;
    if (m.drafts == 0) point.bounds = m.bounds;
    if (!exact_.empty()) point.solver = solverError(solve.mesh(), solve.patchRadiosity(), exact_);
    return point;
  }

  static bool isFurther(const CurvePoint& now, const CurvePoint& last) {
    if (further(now.cpu_seconds, last.cpu_seconds, kFurther)) return true;
    if (further(static_cast<double>(now.rows), static_cast<double>(last.rows), kFurther)) return true;
    if (now.bounds.upper < kNoBound && last.bounds.upper == kNoBound) return true;
    if (!now.solver) return further(last.unshot_fraction, now.unshot_fraction, kFurther);
    return further(last.solver->nrmse, now.solver->nrmse, kFurther) ||
           further(now.solver->nrmse, last.solver->nrmse, kFurther);
  }

  bool isFurtherTotal(const CurvePoint& now) const {
    if (further(now.cpu_seconds, total_at_.cpu_seconds, kFurtherTotal)) return true;
    return now.solver && total_at_.solver &&
           further(total_at_.solver->nrmse, now.solver->nrmse, kFurtherTotal) &&
           now.solver->nrmse > kLeastSolver;
  }

  void measureTotal(const Solve& solve, CurvePoint& point) {
    if (!total_error_) return;
    total_at_ = point;
    const TotalError error = total_error_(solve);
    point.total_error = error.nrmse;
    curve_.why_not_judgeable = error.why_not_judgeable;
  }

  void push(const CurvePoint& point) {
    curve_.points.push_back(point);
    curve_.runs.front().cpu_seconds.push_back(point.cpu_seconds);
    curve_.runs.front().seconds.push_back(point.seconds);
  }

  ModeCurve& curve_;
  std::span<const glm::dvec3> exact_;
  const std::function<TotalError(const Solve&)>& total_error_;
  std::optional<CurvePoint> passed_;
  CurvePoint total_at_;
};

Error memoryFailure(const std::string& mode) {
  return Error(ErrorKind::kEnvironment, "the mode '" + mode + "' found no memory", {},
               "a coarser mesh (--elements), less for form factors (--keep), or other --modes");
}

}  // namespace

ModeCurve CurveRuns::run(const std::string& mode, std::span<const glm::dvec3> exact, double max_seconds,
                         const std::function<TotalError(const Solve&)>& total_error, const RunWatch& watch) {
  const IterationModeRow& row = findChoice(iterationModes(), mode, "iteration mode");
  ModeCurve curve;
  curve.mode = mode;
  curve.title = row.info.title;
  curve.help = row.info.help;
  curve.left_out = unavailable(mode);
  if (!curve.left_out.empty()) return curve;
  try {
    const std::unique_ptr<Solve> solve = begin(mode, options_.error);
    Clock clock(columns_, *solve);
    curve.runs.emplace_back();
    PointPicker picker(curve, exact, total_error);
    picker.see(*solve, 0, clock.cpuNow(), clock.wallNow());
    for (std::uint64_t step = 1; solve->state() == SolveState::kRunning; ++step) {
      clock.step(*solve);
      curve.working_bytes_max = std::max(curve.working_bytes_max, solve->workingBytes());
      picker.see(*solve, step, clock.cpuNow(), clock.wallNow());
      if (!watch(solve->progress())) {
        curve.stopped_by = "interrupted";
        break;
      }
      if (solve->state() == SolveState::kRunning && clock.wallBesideFormFactors() > max_seconds) {
        curve.stopped_by = "max_seconds";
        break;
      }
    }
    picker.end(*solve);
    if (curve.stopped_by.empty()) curve.stopped_by = solve->stoppedBy();
    curve.failure = solve->failure();
    curve.form_factor_seconds = columns_.spent().cpu_seconds;
    curve.kept_bytes = solve->keptBytes();
  } catch (const Error& error) {
    curve.failure = error;
  } catch (const std::bad_alloc&) {
    curve.failure = memoryFailure(mode);
  }
  if (curve.failure && curve.stopped_by.empty()) curve.stopped_by = curve.failure->what();
  takeMedians(curve);
  return curve;
}

ModeCurve CurveRuns::runBounded(const std::string& mode, std::span<const glm::dvec3> exact,
                                double max_seconds, const RunWatch& watch) {
  const bool drafts = std::exchange(options_.draft_first, false);
  ModeCurve curve = run(mode, exact, max_seconds, {}, watch);
  options_.draft_first = drafts;
  return curve;
}

void CurveRuns::repeat(ModeCurve& curve, const RunWatch& watch) {
  if (curve.points.empty()) return;
  const std::unique_ptr<Solve> solve = begin(curve.mode, options_.error);
  Clock clock(columns_, *solve);
  RunTimes times;
  const std::uint64_t last = curve.points.back().step;
  for (std::uint64_t step = 0; step <= last; ++step) {
    if (step > 0) clock.step(*solve);
    if (step == curve.points[times.cpu_seconds.size()].step) {
      times.cpu_seconds.push_back(clock.cpuNow());
      times.seconds.push_back(clock.wallNow());
    }
    if (!watch(static_cast<double>(step) / static_cast<double>(last + 1))) return;
  }
  curve.runs.push_back(std::move(times));
  takeMedians(curve);
}

void CurveRuns::statesAt(const std::string& mode, std::span<const std::uint64_t> steps,
                         const std::function<void(std::size_t, const Solve&)>& take, const RunWatch& watch) {
  if (steps.empty()) return;
  const std::unique_ptr<Solve> solve = begin(mode, options_.error);
  std::uint64_t done = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    for (; done < steps[k]; ++done) {
      solve->step();
      if (!watch(static_cast<double>(done) / static_cast<double>(steps.back()))) return;
    }
    take(k, *solve);
  }
}

}  // namespace unshot
