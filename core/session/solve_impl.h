// What a solve holds, for its own files alone:
// - solve.cpp sets it up, takes its steps and changes what it is asked for;
// - solve_queries.cpp answers what can be asked of it;
// - solve_leap.cpp says when many shots are taken at once;
// - solve_end.cpp says when and why it ends;
// - row_closing.cpp closes its rows;
// - idle_shooters.cpp says which patches need not shoot;
// - saved_solve.cpp writes it into a file and takes it up again;
// - edited_solve.cpp goes on with other materials;
// - finer_solve.cpp goes on on a finer mesh;
// - solve_inside.cpp lets others look on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/bounces.h"
#include "session/coarse_mesh.h"
#include "session/draft_refinement.h"
#include "session/error_budget.h"
#include "session/fields.h"
#include "session/final_gather.h"
#include "session/known_solution.h"
#include "session/last_sweeps.h"
#include "session/leap.h"
#include "session/local_pass.h"
#include "session/saved_solve.h"
#include "session/solve.h"
#include "session/stagnation.h"
#include "solver/ambient.h"
#include "solver/modes.h"

namespace unshot {

inline const Transport& insideTransport(const Solve& solve);
inline const RadiosityState& insideState(const Solve& solve);
inline void computeInside(const Solve& solve, std::uint32_t q);

struct Solve::Impl {
  SolveOptions options;
  Scene scene;
  std::shared_ptr<const Mesh> mesh;
  glm::dvec3 sky{0.0};  // its radiosity [W/m^2]: the source behind all patches; 0: there is none
  std::string mode_key, form_factors_key;
  std::vector<PlanDecision> plan;
  Diagnostics diagnostics;
  PhaseSeconds seconds;
  double cpu_start = 0, solve_start = 0, cpu_setup = 0;

  std::shared_ptr<Workers> workers;
  std::unique_ptr<Transport> transport;
  std::unique_ptr<RadiosityState> state;
  const IterationModeRow* mode_row = nullptr;
  std::unique_ptr<IterationMode> mode;  // made anew where columns have changed: it may hold products of them
  glm::dvec3 most_emitted{0.0};         // per channel, by materials since nothing was shot [W]
  std::unique_ptr<AmbientTerm> ambient;
  std::unique_ptr<ErrorBudget> budget;
  std::unique_ptr<Bounces> bounces_of_light;
  KnownSolution known_solution;
  // Computed before the solve shot again; less than 0, by overflow, where it was taken up with more.
  std::uint64_t rows_before = 0;
  std::uint64_t drawn_before = 0;  // hemicubes, by the solve that this one goes on from

  SolveState progress_state = SolveState::kRunning;
  std::string stopped_by;
  std::optional<Error> failure;
  Measures measures;
  std::vector<HistoryEntry> history;
  bool resting = false, mode_failed = false, room_noted = false, error_noted = false;
  std::uint32_t next_idle = 0;    // all before have a column, where patches that need not shoot are to
  std::uint32_t next_column = 0;  // all before are known, or nothing is sent from there
  // Whether rows are still to be closed (formfactor/closure.h), and what escapes of each receiver's view
  // where that is known; empty: no surface has seen an opening so far.
  bool closure_pending = false, high_gain = false;
  bool closure_hurries = false;  // without it the solve does not get anywhere
  std::vector<float> escape;
  DraftRefinement drafts;
  double measured_wall = 0, measured_cpu = 0;  // when `measures` were taken
  SharedFields shared;
  StagnationWatch stagnation;
  std::unique_ptr<LocalPass> local_pass;      // where the mesh is refined
  std::unique_ptr<FinalGather> final_gather;  // where hemicubes leave more than its noise
  double gather_seconds = 0;                  // that it is kept of a limited time
  std::optional<std::string> finished_by;     // what ends the solve once what follows is through
  SolveState finishes_as = SolveState::kConverged;
  LastSweeps last_sweeps;
  Leap leap;
  std::uint64_t shots_at_hand = 0;  // along columns at hand, since the last leap
  int local_passes_left = 0;
  bool begun_solved = false;              // by the trial of its mesh, whose local pass is at its end too
  double mesh_error = 0;                  // that the mesh was made for
  bool relit = false;                     // and that it was made for other emitters
  bool on_finer_mesh = false;             // than it began on
  std::vector<glm::dvec3> handed;         // S that the solve before hands over, one per source, and
  std::vector<std::uint32_t> hand_order;  // whose is still to be sent, the last next
  std::size_t handed_count = 1;           // of these, at the start

  Impl(Scene scene_in, SolveOptions options_in)
      : options(std::move(options_in)),
        scene(std::move(scene_in)),
        workers(std::make_shared<Workers>(options.threads)) {}

  void prepare(const std::function<gl::Context&()>& gl, const CancelToken& cancel,
               std::shared_ptr<SavedSolve> saved);
  void setUp(const std::function<gl::Context&()>& gl, const CancelToken& cancel);
  void begin();
  void endWithoutLight();
  void takeOver(Impl& before);
  void takeLightOf(const Impl& before);
  void sendHanded();
  double shareTakenOver() const;
  std::optional<double> finerMeshError() const;
  bool missesError() const;
  void beginWith(SolvedAtOnce solved);
  SavedSolve head() const;
  void restore(SavedSolve& saved);
  void takeUp(const SavedSolve& saved);
  void makeTransport(const std::function<gl::Context&()>& gl, const CancelToken& cancel);
  void chooseMode(const std::string& key);
  void stop(SolveState how, std::string why);
  void failWithoutSolution();
  void fail(ErrorKind kind, std::string why, std::string advice);
  void wakeClocks();
  void learnSolution();
  void measure();
  bool reached();
  std::string boundReached() const;
  void checkLimits();
  void checkStagnation();
  void checkEnergy();
  void noteMissingRoom();
  void noteMissedError();
  double target() const;
  std::vector<glm::dvec3> shownIrradiance() const;
  MeshField shownField() const;
  void planGather();
  void finish(std::string why);
  void finishAs(SolveState how, std::string why);
  void sharpenByGather();
  void finishBegun();
  void sharpen();
  void record();
  void refine();
  bool endsNearTheTruth() const;
  void decide(PlanDecision decision);
  bool leapIsDue() const;
  bool takeLeap();
  bool sweeps() const { return leap.running() || last_sweeps.running(); }  // at the end
  void advance(std::uint64_t most_shots);
  bool lacksBound() const;
  bool completeColumns();
  bool computeIdle();
  void sayIdle();
  void planClosure(const CancelToken& cancel);
  void noteOpening(double escape);
  bool closureIsDue() const;
  bool closureIsUrgent();
  bool closeRows();
  bool iterate(std::uint64_t most_shots);

  void computeKeptColumn(std::uint32_t q);

  // For solve_inside.cpp: no function beside Solve's own may name its Impl.
  static Impl& of(const Solve& solve) { return *solve.impl_; }
  friend const Transport& insideTransport(const Solve& solve) { return *of(solve).transport; }
  friend const RadiosityState& insideState(const Solve& solve) { return *of(solve).state; }
  friend void computeInside(const Solve& solve, std::uint32_t q) { of(solve).computeKeptColumn(q); }
};

}  // namespace unshot
