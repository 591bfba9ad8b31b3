// The live solve: a thread of its own that reads, meshes and solves; commands in, immutable states out,
// nothing else (law 5).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "session/solve.h"

namespace unshot {

struct Insight;
struct InsightWanted;

enum class SessionPhase {
  kEmpty,      ///< no scene was asked for yet, or the first one failed
  kLoading,    ///< a scene is read or meshed; what was shown before stays
  kRunning,    ///< shooting
  kPaused,     ///< waits for resume or step
  kConverged,  ///< the error asked for is reached
  kStopped,    ///< a limit of the options is reached (max_shots, max_seconds)
  kFailed,     ///< numerical trouble, or a step threw; the last good snapshot stays
};

/// What stays the same during one solve; made anew when its mode or error is set, or when it has
/// something new to say.
struct SolveFacts {
  std::filesystem::path scene_path;
  std::string scene_name;
  SolveOptions options;            ///< as asked for; `error` and `mode` follow the commands
  double solver_target = 0;        ///< Solve::solverTarget
  std::string mode, form_factors;  ///< keys: what `auto` became
  std::vector<PlanDecision> plan;
  Diagnostics diagnostics;
  std::size_t triangles = 0;  ///< of the scene
  /// Line of the scene's file of one polygon of each surface.
  std::shared_ptr<const std::vector<std::uint32_t>> surface_lines;
  std::size_t surfaces = 0, patches = 0, elements = 0, vertices = 0;
  double load_seconds = 0, mesh_seconds = 0;
};

/// One solve of the session at one moment. Everything it points to is immutable.
struct LaneState {
  std::shared_ptr<const SolveFacts> facts;   ///< null before the first scene
  std::shared_ptr<const Snapshot> snapshot;  ///< the last good one; null before the first scene
  std::shared_ptr<const std::vector<HistoryEntry>> history;  ///< of this solve, up to this moment
  Measures measures;  ///< as of this moment; while running the snapshot may be older (Snapshot::measures)
  ErrorEstimates estimates;  ///< refined while nothing else is to be done
  /// Bracket of the spectral radius of M, per channel; upper infinite where it is not known.
  glm::dvec3 radius_lower{0.0}, radius_upper{kNoBound};
  /// How much of the matrix that is looked into is gathered, from 0 to 1; none where none is being gathered.
  std::optional<double> gathering;
  /// How much of what completeBounces() asked for is computed, likewise.
  std::optional<double> completing;
  bool bounces_under_way = false;  ///< light by bounces is being worked out, or will be once the solve rests
  bool spare_work = false;     ///< the solve rests, and its estimates or light by bounces still get better
  double progress = 0;         ///< Solve::progress
  std::string activity;        ///< Solve::activity
  bool finer_mesh = false;     ///< the light is about to go over to a finer mesh, or under way to it
  std::size_t kept_bytes = 0;  ///< memory held by kept columns
  std::shared_ptr<const Insight> insight;         ///< what was asked for by lookInto(); null before that
  std::uint64_t drawn = 0;                        ///< hemicubes drawn
  std::string stopped_by;                         ///< Solve::stoppedBy, or what a step threw
  SessionPhase own_phase = SessionPhase::kEmpty;  ///< of this solve by itself
};

/// What a solve went on from.
struct ResumedFrom {
  std::filesystem::path path;
  std::uint64_t shots = 0;
  double seconds = 0;  ///< of solving, until then
};

/// One moment of the session, with the state of its solve.
struct SessionState : LaneState {
  std::uint64_t version = 0;                  ///< one more at each publication
  std::uint64_t epoch = 0;                    ///< one more where shots count from 0 again; 0: none yet
  std::uint64_t commands = 0;                 ///< how many of the commands sent are carried out
  SessionPhase phase = SessionPhase::kEmpty;  ///< in a race kRunning or kPaused until both have ended
  std::string
      task;  ///< while loading, saving, editing or refining: what is being done, such as "reading room.obj"
  std::optional<double> task_done;                   ///< how much of it, from 0 to 1, where that is known
  double task_began = 0;                             ///< wallSeconds() then
  double loading_began = 0;                          ///< the same, of the first task of what is being loaded
  double gathering_began = 0, completing_began = 0;  ///< the same, of LaneState::gathering and completing
  bool saving = false;                               ///< it is saving, which leaves the phase as it is
  bool editing = false;                              ///< it gets ready for other materials, likewise
  bool refining = false;                             ///< it cuts a finer mesh, likewise
  std::optional<LaneState> rival;                    ///< in a race: the other solve
  std::optional<ResumedFrom> resumed;                ///< of the present solve, where it was saved before
  std::uint64_t problems = 0;                        ///< how many commands or solves have failed so far
  std::optional<Error> problem;                      ///< the last failure
  std::uint64_t saves = 0;                           ///< how often save() has written a file
  std::filesystem::path saved_as;                    ///< the last of them

  /// Whether there are more news to wait for while the session rests.
  bool spareWork() const { return spare_work || (rival && rival->spare_work); }
};

/// A solve that is saved again and again, so that little is lost however the program ends.
struct KeptSolve {
  std::filesystem::path path;   ///< empty: none is kept
  double every = 60;            ///< seconds between two saves at least, as class Saver has it
  std::filesystem::path scene;  ///< as open() names it; solves of other scenes are not saved there
};

struct SessionSetup {
  /// For the solver thread alone: made and destroyed by the caller, current nowhere, outlives the session.
  /// Null: methods that draw fail with an Error.
  gl::Context* gl = nullptr;
  /// Called on the solver thread after each publication; must not throw. It may call all of the session but
  /// its destructor.
  std::function<void()> wake;
  /// Saved while it runs, when another scene takes its place, and when the session closes. What cannot be
  /// saved is published as `problem`.
  KeptSolve kept = {};
};

/// All member functions may be called from any thread and return at once; only close() and the destructor
/// wait.
class Session {
 public:
  explicit Session(SessionSetup setup);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Ends the solver thread, as the destructor does; latest() then tells what became of it. Waits for one
  /// step at most, and for what is still to be saved; loading is given up. Nothing but latest() and sent()
  /// may be called afterwards.
  void close();
  /// Begins with that, and does not wait: commands that are sent from now on are not carried out, but
  /// giveUpSaving() is heard.
  void beginClosing();
  /// Whether the thread has ended. After beginClosing() SessionSetup::wake is called once it has.
  bool closed() const;

  /// While one lives no step is taken, though commands are carried out: what is sent meanwhile happens
  /// without a shot in between. A step under way ends.
  class Hold {
   public:
    explicit Hold(Session& session);
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    Session& session_;
  };

  // Commands, carried out in order between two steps. What fails leaves the session as it was and is
  // published as `problem`. A command that has nothing to do in the present phase (pause without a scene,
  // step of a converged solve) does nothing.

  /// Reads a scene and solves it. The scene before goes on being shown, and is gone only when this one is
  /// ready. One that is still being loaded is given up for this one, and never shown. The new solve runs from
  /// the first moment; a pause sent after this command finds it before its first shot.
  void open(std::filesystem::path scene, SolveOptions options);
  /// The same, but the solve goes on from one that was saved, as Solve::Solve describes it. The file's error
  /// stands in the place of that of `options` unless that is `error_given`.
  void resumeSaved(std::filesystem::path scene, SolveOptions options, std::filesystem::path saved,
                   bool error_given);
  /// Gives up what is being loaded now: what was before stays, and goes on. Commands that wait are carried
  /// out.
  void giveUpLoading();
  /// Gives up the save under way, if there is one: a file that is there stays as it was.
  void giveUpSaving();
  /// The present scene as it was read, from the start, with these options; open() reads the file again.
  /// Another restart that is not ready is given up.
  void restart(SolveOptions options);
  /// The present solve from nothing shot, on the same mesh and with the form factors at hand.
  void shootAgain();
  /// The present solve goes on with the reflectance and emission of these materials (Solve's constructor of
  /// edits): what was shot and received stays, but begins anew in a race, after a step that threw, or where
  /// they emit in places that were dark. Of edits sent before one is carried out the last counts.
  /// giveUpLoading() gives it up too: the materials before stay.
  void edit(std::vector<Material> materials);
  void pause();
  void resume();
  /// `shots` more steps (in a race: of each solve), added to those still due, then a pause; 0 where none are
  /// due: a pause.
  void step(std::uint64_t shots);
  /// Another iteration mode; what was shot and received stays, but in a race both solves begin anew.
  void setMode(std::string key);
  /// Another error to aim for (SolveOptions::error): a converged solve that has not reached it runs again,
  /// one that has converges at once.
  void setError(double error);
  /// While the present solve rests: computes the form factors that light by bounces still waits for
  /// (Snapshot::bounce_wait). Where none are missing it needs no asking.
  void completeBounces();
  /// Leaves the rest of them missing.
  void giveUpBounces();
  /// What LaneState::insight is to hold from now on (session/insight.h), of the present solve and of those
  /// that come. The column of a patch that is not at hand is computed for it.
  void lookInto(const InsightWanted& wanted);

  /// The present solve from nothing against another one of the same scene in the mode `key`: in turns, each
  /// always as long as the other [s of its own clock], with half of the memory for columns each. It goes on
  /// through restart(), shootAgain() and setMode() (which then begins anew) and ends with open().
  void race(std::string mode);
  /// Leaves the other solve; the first goes on.
  void endRace();

  /// Saves the present solve (in a race the first one) as Solve::save does; it goes on. What is sent before
  /// the session closes is carried out.
  void save(std::filesystem::path path);

  /// How many commands were sent so far; they are carried out when latest()->commands says the same.
  std::uint64_t sent() const;
  /// Never null.
  std::shared_ptr<const SessionState> latest() const;

  /// Least time between two publications while running [s]; at least (and by default) 1/30, and at least ten
  /// times what the last snapshot cost to make. Commands and changes of phase are published at once; while
  /// running they bring a new snapshot only where one is due.
  void setPublishInterval(double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace unshot
