// One solve from scene to converged light, as a plain object that takes steps: no thread, no window.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/error.h"
#include "formfactor/methods.h"
#include "scene/scene.h"
#include "session/energy.h"
#include "session/residuals.h"
#include "session/scene_plan.h"
#include "session/snapshot.h"

namespace unshot {

namespace gl {
class Context;
}
class FormFactorMethod;
struct SavedSolve;

/// What the user asks of a solve. Keys are those of the tables (`unshot list`).
struct SolveOptions {
  std::string mode = "auto";
  std::string form_factors = "auto";
  /// What `auto` form factors are where something can occlude: hemicubes, which show how light is shot, or
  /// what is soonest as exact as asked for.
  bool soonest = false;
  std::optional<std::uint64_t> elements;  ///< over all lit sides; at most one of elements and element_size
  std::optional<double> element_size;     ///< [m], edge of an element
  /// Without the two, and with form factors at vertices, the mesh follows the light (light_refinement.h), as
  /// fine as `error` asks for and of about so many elements at most.
  std::uint64_t max_elements = 1'000'000;
  DoAnyway do_anyway;  ///< of what the plan would leave out (scene_plan.h)
  bool emit_front_only = false;
  std::optional<glm::dvec3> sky;  ///< radiosity of the sky [W/m^2]; without, see skyOver (scene/sky.h)
  double error = 0.01;            ///< stop when the bound of the solver's error is below Solve::solverTarget
  std::optional<double>
      mesh_error;  ///< a mesh that follows the light is as fine as this asks for, not `error`
  std::optional<double> max_seconds;
  std::optional<std::uint64_t> max_shots;
  /// Only the light of so many bounces, E + M E + ... + M^n E, whatever its error: the mode is `jacobi`,
  /// which ends after as many sweeps, and without drafts.
  std::optional<std::uint64_t> bounces;
  std::uint64_t seed = 1;
  /// Solves with drafts of the form factors first, where method and mode have use for them, then replaces
  /// them one by one, while the solution stays up to date: a whole picture after a tenth of the columns, the
  /// end at about the same time.
  bool draft_first = true;
  /// Whether final gathering (final_gather.h) ends the solve; none: where preparation says so.
  std::optional<bool> final_gather;
  std::uint32_t hemicube_resolution = 0;  ///< pixels along the top face; 0: chosen
  HemicubeDrawing hemicube_drawing = HemicubeDrawing::kAuto;
  std::size_t kept_bytes = std::size_t{1} << 30;  ///< memory for kept columns of K [bytes]
  unsigned threads = 0;     ///< that share out large pieces of work; 0: one for each core. The same result.
  std::size_t sharers = 1;  ///< solves that share `kept_bytes` in equal parts, this one included
  /// Where given: of the same scene, cut by the same options; it is not cut again.
  std::shared_ptr<const Mesh> mesh;
  /// Where given: stands between the solve and its form-factor method, such as to keep columns for another
  /// solve of the same scene and options.
  std::function<std::unique_ptr<FormFactorMethod>(std::unique_ptr<FormFactorMethod>)> wrap_form_factors;
};

struct HistoryEntry {
  Measures measures;
};

struct PhaseSeconds {
  double load = 0, mesh = 0, plan = 0, solve = 0;  ///< wall time
  double cpu_solve = 0;                            ///< CPU of mesh + plan + solve + estimates
};

enum class SolveState { kRunning, kConverged, kLimit, kInterrupted, kFailed };

/// The scene with the reflectance and emission of these, as many as it has; their names count for nothing.
/// Throws a usage Error for a reflectance outside 0 to 1, an emission that is below 0 or not finite.
Scene editedScene(Scene scene, const std::vector<Material>& materials);

/// The solve. All calls come from one thread, on which the GL context (if any) is current.
class Solve {
 public:
  /// `gl` is called at most once, only when the form-factor method needs GL; the context stays the caller's
  /// and outlives the Solve. Meshes the scene and sets the method up. Throws Error (kUsage for unknown keys
  /// or impossible options), Cancelled where `cancel`, of which it keeps nothing, asks for it.
  /// Where `saved` is given it goes on from there: SavedSolve::options stand in the place of those of
  /// `options`, and max_seconds and max_shots count from here. Throws Error (kInput) where it is of another
  /// scene.
  Solve(Scene scene, SolveOptions options, std::function<gl::Context&()> gl, const CancelToken& cancel = {},
        std::shared_ptr<SavedSolve> saved = nullptr);
  /// Goes on from `before` with other materials (editedScene): what was shot and received stays, and so do
  /// the mesh and the form factors at hand; what the edit changes is unshot, of either sign. `before` gives
  /// its form factors away, and is to be destroyed; where this throws it is as it was (kUsage where canEdit()
  /// says no; kEnvironment: a mode that is not for these materials).
  Solve(Solve& before, const std::vector<Material>& materials, const std::function<gl::Context&()>& gl,
        const CancelToken& cancel = {});
  /// Goes on from `before` on another mesh: as finerMeshError() of `before` says, which has to have a value.
  /// What a patch has shot, those have that lie where it lies, and what the finer mesh finds otherwise is
  /// unshot, of either sign. Clocks and counts go on. `before` stays as it is, and is what to show and to
  /// save as long as takesOver().
  Solve(const Solve& before, const std::function<gl::Context&()>& gl, const CancelToken& cancel = {});
  ~Solve();
  Solve(const Solve&) = delete;
  Solve& operator=(const Solve&) = delete;

  /// One step of the iteration mode (a shot, or a part of a sweep), or one draft replaced. Where `most_shots`
  /// allows it, several shots, two of them at most along columns that have to be computed: up to one for each
  /// 200 before and fewer of many receivers, so that measures and limits are looked at less often. Does
  /// nothing once state() is not kRunning. A step takes milliseconds to a few tens of them, so that limits
  /// and interruption act soon.
  void step(std::uint64_t most_shots = 1);
  static constexpr std::uint64_t kMostAtOnce = 16;

  /// Another iteration mode, which goes on from what was shot and received; columns at hand stay. It
  /// revives a solve that failed because its mode could not go on, none that has ended otherwise. Throws an
  /// Error for an unknown key (kUsage) or a mode that is not for this scene (kEnvironment).
  void setMode(const std::string& key);
  /// Another SolveOptions::error: a running solve (or one at a limit) that has reached it converges at once,
  /// a converged one that has not runs again. Throws a usage Error unless 0 < error < 1.
  void setError(double error);
  /// Whether the mesh has elements where these materials emit; where it has none, as they lie in the dark
  /// now, the scene is to be meshed again.
  bool canEdit(const std::vector<Material>& materials) const;
  /// Shoots again from nothing in the present mode, with the form factors at hand: clocks, counts and history
  /// begin anew.
  void again();
  /// The error that another mesh is to be made for, once the solve has converged: where this one follows the
  /// light and was made for a larger error than is asked for now, or for other emitters and is by estimate
  /// far from it. Nothing where it is as it should be or has as many elements as it may.
  std::optional<double> finerMeshError() const;
  /// Whether light of the solve before, on its coarser mesh, is still to be sent over this one.
  bool takesOver() const;
  /// Estimates what form factors and mesh leave wrong in the present state, from so many more places than
  /// before; the solve's clocks rest, but its cpu_solve counts it.
  const ErrorEstimates& estimate(std::size_t more_places);
  const ErrorEstimates& estimates() const;
  std::size_t places() const;  ///< that estimates() are from
  /// The next estimate is from places of its own alone, chosen by the light as it is then.
  void forgetPlaces();
  const ErrorBounds& bounds() const;
  /// Goes on working out the light by bounces (Snapshot::bounce_light), from form factors at hand and for
  /// some milliseconds; those that are missing are computed first where `compute` allows it, one a call. The
  /// clocks rest. Returns whether anything is new.
  bool workOutBounces(bool compute);
  bool hasBouncesToWorkOut(bool compute) const;
  /// What light by bounces still waits for.
  BounceWait bounceWait() const;
  /// Sums the rows of K for snapshots, where all of it is at hand. Returns whether that is new.
  bool sumRows();
  double errorSeconds() const;  ///< wall time that bounds and estimates took so far
  /// Stops the clocks of `measures`, as the last step left them, until the next step.
  void rest();

  /// What the bound of the solver's error (Measures::solverBound) is held against: SolveOptions::error or,
  /// where the mesh was made for it and the error is that of the whole, the solver's share of it.
  double solverTarget() const;
  SolveState state() const;
  /// Ends the solve as interrupted; what was reached stays.
  void interrupt();

  /// Writes all that it takes to go on later (saved_solve.h): whole, or not at all and the file that was
  /// there before stays. Throws Error (kEnvironment).
  void save(const std::filesystem::path& path, const CancelToken& cancel = {}) const;

  /// A copy of the present state for display and export.
  Snapshot snapshot() const;
  const Measures& measures() const;
  /// Fraction of the work done, from the unshot fraction on a log scale: 0 at the start, 1 converged. While
  /// final gathering is under way, of that.
  double progress() const;
  bool gathers() const;  ///< whether it is
  /// What was gathered last and is shown; changes with every round of looks. Null: nothing.
  const void* gathered() const;
  /// What is done besides shooting, such as "factorising" by the mode; empty: nothing, or it has ended.
  std::string activity() const;

  // For reports.
  const glm::dvec3& sky() const;  ///< radiosity of the sky [W/m^2]; 0 where none is seen
  /// B = S + U [W/m^2], one per patch and, where there is a sky, its own behind them.
  std::vector<glm::dvec3> patchRadiosity() const;
  const SolveOptions& options() const;  ///< as asked for; `mode` and `error` as set last
  const Scene& scene() const;
  const Mesh& mesh() const;
  const std::string& modeKey() const;         ///< what `auto` became
  const std::string& formFactorsKey() const;  ///< what `auto` became
  const std::vector<PlanDecision>& plan() const;
  const Diagnostics& diagnostics() const;  ///< of scene, mesh and solve
  const std::vector<HistoryEntry>& history() const;
  EnergyBalance energy() const;
  const PhaseSeconds& seconds() const;
  std::size_t keptBytes() const;  ///< memory held by kept columns
  /// Memory of the state and of what the mode holds beside it [bytes].
  std::size_t workingBytes() const;
  std::uint64_t drawn() const;  ///< hemicubes drawn
  /// The bound that reached the error asked for ("solver_upper", "solver_total_upper"), "nothing unshot",
  /// "max_seconds", "max_shots", "bounces", "interrupted", "no light", or what failed.
  const std::string& stoppedBy() const;
  /// What failed and what to try: kInput where the scene has no finite solution, kInternal for numerical
  /// trouble. Nothing unless state() is kFailed.
  const std::optional<Error>& failure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace unshot
