// The runs that curves are made from: a scene is solved by one mode after the other, each from E on.
//
// The clock of a run is busy time: CPU of this process during mesh, plan and steps, with the cost of every
// column that the run asked for (ColumnStore), without what is measured between the steps.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/column_store.h"
#include "report/error_curves.h"
#include "scene/scene.h"
#include "session/solve.h"

namespace unshot {

/// What is told of a run under way; `fraction` of it is done. Returns false to end it.
using RunWatch = std::function<bool(double fraction)>;
/// Total error of a state, and why it cannot be judged (empty: it can).
struct TotalError {
  double nrmse = 0;
  std::string why_not_judgeable;
};

/// The exact solution of a scene's discrete system.
struct ExactSolution {
  std::vector<glm::dvec3> radiosity;  ///< B*, one per patch [W/m^2]; empty: there is none
  std::string mode;                   ///< that found it
  double unshot_fraction = 1;         ///< that was left
  double seconds = 0;                 ///< wall time that it took
  std::string why_not;                ///< there is none
  bool interrupted = false;
};

/// One scene with the options of its solves. One thread, that of the GL context.
class CurveRuns {
 public:
  /// `options.error` is where runs end (their bound is below it); its mode and limits are not used. `gl` as
  /// for a Solve.
  CurveRuns(const Scene& scene, SolveOptions options, std::function<gl::Context&()> gl);

  /// By `direct` where that is quick, else by `gmres`. Takes `max_seconds` at most (wall time). Throws what a
  /// Solve throws, kInput where the scene has no light or no finite solution. Where it finds none, runs are
  /// without drafts: bounds stand in its place.
  ExactSolution solveExactly(double max_seconds, const RunWatch& watch);

  /// A first run of the mode, with its errors: the points lie where error, time, rows or shots have changed
  /// by a tenth. Total errors are asked for at about every third point. Ends after `max_seconds` of wall time
  /// beside form factors. Throws nothing but what `watch` and `total_error` throw: what failed stands in the
  /// curve.
  ModeCurve run(const std::string& mode, std::span<const glm::dvec3> exact, double max_seconds,
                const std::function<TotalError(const Solve&)>& total_error, const RunWatch& watch);
  /// The same without drafts of form factors, so that bounds are of the system that `exact` solves from the
  /// first shot on; no total errors.
  ModeCurve runBounded(const std::string& mode, std::span<const glm::dvec3> exact, double max_seconds,
                       const RunWatch& watch);
  /// One more run of the same, for its times: form factors are measured anew in each round (measureAnew of
  /// `columns`). An incomplete one adds nothing.
  void repeat(ModeCurve& curve, const RunWatch& watch);
  /// The states of a mode at these steps (ascending), handed to `take` with the index of the step.
  void statesAt(const std::string& mode, std::span<const std::uint64_t> steps,
                const std::function<void(std::size_t, const Solve&)>& take, const RunWatch& watch);

  ColumnStore& columns() { return columns_; }
  /// Why the mode cannot solve this scene; empty: it can. Known once a solve has been made.
  std::string unavailable(const std::string& mode) const;

  /// Figures of the scene's solves; known once one has been made.
  struct Figures {
    std::string form_factors;
    std::vector<PlanDecision> plan;
    Diagnostics diagnostics;
    std::size_t surfaces = 0, elements = 0, patches = 0, vertices = 0;
  };
  const Figures& figures() const { return figures_; }

 private:
  struct Clock;
  std::unique_ptr<Solve> begin(const std::string& mode, double error);

  const Scene& scene_;
  SolveOptions options_;
  std::function<gl::Context&()> gl_;
  ColumnStore columns_;
  Figures figures_;
  std::vector<glm::dvec3> reflectance_;  // one per patch
};

}  // namespace unshot
