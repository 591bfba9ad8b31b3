#include "stability/stability_run.h"

#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "solver/modes.h"

namespace unshot {
namespace {

/// What the solve says of a method whose result would be wrong here.
std::optional<std::string> unsuited(const Solve& solve) {
  for (const Diagnostic& d : solve.diagnostics()) {
    if (d.code == "unsuited-method") return d.message;
  }
  return std::nullopt;
}

/// How a case ends that has no finite solution: said, after so many passes over all patches at most.
Figure passesUntilSaid(const Solve& solve, double most) {
  const double patches = std::max<double>(1, solve.mesh().patch_count);
  return {"passes until it says so", static_cast<double>(solve.measures().shots) / patches, most, 0, true};
}

/// Returns whether what is wrong, if anything, is that it stopped short, in a state that is sound.
bool judge(const StabilityCase& trial, const Solve& solve, StabilityResult& result) {
  std::vector<Figure> figures;
  const SolveState wanted = trial.no_solution ? SolveState::kFailed : SolveState::kConverged;
  if (trial.no_solution) {
    figures.push_back(passesUntilSaid(solve, kMostPasses));
  } else {
    figures = trial.measure(solve);
    if (result.fineness == Fineness::kLight) {
      for (Figure& f : figures) {
        if (f.tolerance > 0) f.tolerance = std::max(f.tolerance, kLightTolerance);
      }
    }
  }
  result.figure = *std::max_element(figures.begin(), figures.end(),
                                    [](const Figure& a, const Figure& b) { return a.strain() < b.strain(); });
  const std::optional<Error>& failure = solve.failure();
  if (solve.state() != wanted) {
    result.note = "stopped by " + solve.stoppedBy();
  } else if (trial.no_solution && failure->kind() != ErrorKind::kInput) {
    result.note = std::string("it blames itself: ") + failure->what();
  } else if (!result.figure.within()) {
    result.note = result.figure.what + " is off";
  }
  if (!stateIsSound(solve)) {
    result.note = "the state holds values that are negative or not finite; " + result.note;
    return false;
  }
  if (result.note.empty()) result.verdict = Verdict::kPass;
  return solve.state() != wanted;
}

bool attempt(const StabilityCase& trial, Scene scene, const SolveOptions& options,
             const std::function<gl::Context&()>& gl, const CancelToken& cancel, StabilityResult& result) {
  Solve solve(std::move(scene), options, gl, cancel);
  result.mode = solve.modeKey();
  result.form_factors = solve.formFactorsKey();
  if (const auto reason = unsuited(solve)) {
    result.verdict = Verdict::kRefused;
    result.note = *reason;
    return false;
  }
  while (solve.state() == SolveState::kRunning) {
    cancel.check();
    solve.step(Solve::kMostAtOnce);
  }
  return judge(trial, solve, result);
}

/// The reason that the table gives for what this combination shows, if any.
std::optional<std::string> knownReason(const StabilityCase& trial, const StabilityResult& result,
                                       bool stopped) {
  for (const KnownException& known : trial.exceptions) {
    if (known.key != result.mode && known.key != result.form_factors) continue;
    if (known.most > 0 ? !stopped && result.figure.strain() <= known.most : stopped)
      return std::string(known.reason);
  }
  return std::nullopt;
}

}  // namespace

std::string_view nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kRefused:
      return "refused";
    case Verdict::kException:
      return "exception";
    default:
      return "FAIL";
  }
}

std::string_view nameOf(Fineness fineness) { return fineness == Fineness::kEven ? "even" : "light"; }

StabilityResult runStability(const StabilityCase& trial, const std::string& mode,
                             const std::string& form_factors, const std::function<gl::Context&()>& gl,
                             Fineness fineness, const CancelToken& cancel) {
  StabilityResult result;
  result.fineness = fineness;
  result.case_key = trial.key;
  result.mode = mode;
  result.form_factors = form_factors;
  result.figure.got = std::numeric_limits<double>::quiet_NaN();
  SolveOptions options = trial.options;
  options.mode = mode;
  options.form_factors = form_factors;
  options.soonest = true;  // as `unshot solve`
  if (fineness == Fineness::kLight) {
    options.elements.reset();
    options.element_size.reset();
    options.error = kLightError;
  }
  options.max_seconds = trial.most_seconds;
  // While the program says that something is not for a scene, it does so in its own words; no folder for
  // files and no OpenGL have no excuse.
  bool own_words = false, stopped = false;
  const auto watched_gl = [&]() -> gl::Context& {
    own_words = false;
    gl::Context& context = gl();
    own_words = true;
    return context;
  };
  const double began = wallSeconds();
  try {
    Scene scene = trial.make();
    own_words = true;
    stopped = attempt(trial, std::move(scene), options, watched_gl, cancel, result);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kEnvironment && own_words) result.verdict = Verdict::kRefused;
    result.note = error.what();
  } catch (const std::bad_alloc&) {
    result.note = "out of memory";
  } catch (const std::exception& error) {
    result.note = std::string("internal error: ") + error.what();
  }
  result.seconds = wallSeconds() - began;
  if (result.verdict != Verdict::kFail) return result;
  if (const auto reason = knownReason(trial, result, stopped)) {
    result.verdict = Verdict::kException;
    result.note += (result.note.empty() ? "" : ": ") + *reason;
  }
  return result;
}

}  // namespace unshot
