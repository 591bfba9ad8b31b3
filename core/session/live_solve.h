// What the solver thread of a Session does, without the thread: carries out commands, takes steps, and hands
// out a state where one is due.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/memory_reserve.h"
#include "session/insight.h"
#include "session/lane.h"
#include "session/saver.h"
#include "session/session.h"

namespace unshot {

/// The commands of a Session, which documents them.
namespace command {
struct Open {
  std::filesystem::path scene;
  SolveOptions options;
  std::filesystem::path saved;  // to go on from; empty: from nothing
  bool error_given = false;     // by `options`, not by that
};
struct Restart {
  SolveOptions options;
};
struct Edit {
  std::vector<Material> materials;
  std::uint64_t instead_of = 0;  ///< edits sent before that this one stands for too
};
struct Pause {};
struct Resume {};
struct Step {
  std::uint64_t shots;
};
struct SetMode {
  std::string key;
};
struct SetError {
  double error;
};
struct CompleteBounces {
  bool wanted = true;
};
struct LookInto {
  InsightWanted wanted;
};
struct ShootAgain {};
struct Race {
  std::string mode;
};
struct EndRace {};
struct Save {
  std::filesystem::path path;
};
}  // namespace command

using Command =
    std::variant<command::Open, command::Restart, command::Edit, command::Pause, command::Resume,
                 command::Step, command::SetMode, command::SetError, command::CompleteBounces,
                 command::LookInto, command::ShootAgain, command::Race, command::EndRace, command::Save>;

/// Whether loading for `command` is in vain, since `later` loads another scene or the same one again.
bool isSuperseded(const Command& command, const Command& later);

/// What is shared with the threads that own it.
struct LiveSolveSetup {
  gl::Context* gl = nullptr;                                         ///< as SessionSetup::gl
  std::function<void(std::shared_ptr<const SessionState>)> publish;  ///< takes each new state
  std::function<bool()> none_waits;  ///< whether all commands sent are carried out, or one is being
  const std::atomic<bool>* given_up = nullptr;    ///< loading ends where it is raised
  std::atomic<bool>* save_given_up = nullptr;     ///< as saving does
  const std::atomic<double>* interval = nullptr;  ///< of publication [s]
  KeptSolve kept;                                 ///< as SessionSetup::kept
};

/// Made, used and destroyed on one thread; the GL context is current there from its first need to the end.
class LiveSolve {
 public:
  explicit LiveSolve(LiveSolveSetup setup);
  ~LiveSolve();
  LiveSolve(const LiveSolve&) = delete;
  LiveSolve& operator=(const LiveSolve&) = delete;

  /// Carries it out and publishes. What fails becomes SessionState::problem; what is given up leaves all as
  /// it was.
  void carryOut(const Command& command);
  /// Whether step() has something to do.
  bool running() const { return phase() == SessionPhase::kRunning; }
  /// One step of the solve, or in a race of the one that has had less time; publishes where due.
  void step();
  /// Whether spareWork() has something to do while nothing else has.
  bool hasSpareWork() const;
  /// Light by bounces, then errors estimated from more places; publishes where there is news.
  void spareWork();
  /// What is left to do before the end: saves the solve that is kept.
  void finish();
  /// After one of these threw std::bad_alloc, where not even a message or a state found memory: publishes
  /// with memory that was set aside. May be tried again where it throws too.
  void recover();

 private:
  void perform(const command::Open& c);
  void perform(const command::Restart& c);
  void perform(const command::Edit& c);
  void perform(const command::Pause&);
  void perform(const command::Resume&);
  void perform(const command::Step& c);
  void perform(const command::SetMode& c);
  void perform(const command::SetError& c);
  void perform(const command::CompleteBounces&);
  void perform(const command::LookInto& c);
  void perform(const command::ShootAgain&);
  void perform(const command::Race& c);
  void perform(const command::EndRace&);
  void perform(const command::Save& c);

  SessionPhase phase() const;
  gl::Context& context();
  Lane& present();
  std::optional<std::string> rivalMode() const;
  /// How a solve, or a race of two, begins.
  struct Start {
    Scene scene;
    SolveOptions options;
    double load_seconds = 0;
    std::optional<std::string> rival_mode = std::nullopt;
    std::shared_ptr<const Mesh> mesh = nullptr;   ///< where it is at hand
    std::shared_ptr<SavedSolve> saved = nullptr;  ///< to go on from
  };
  std::unique_ptr<Lane> makeLane(Scene scene, const SolveOptions& own, const SolveOptions& asked,
                                 double load_seconds, std::shared_ptr<SavedSolve> saved = nullptr);
  void begin(Start start);
  bool isKept() const;
  void offerToSaver();
  void saveKept();
  void takeSteps();
  bool meshIsToBeRefined() const;
  void refineMesh();
  void announce(const std::string& task);
  /// Tells of a task that leaves the phase as it is, for as long as it lives.
  class TaskBeside {
   public:
    TaskBeside(LiveSolve& live, std::string task, bool LiveSolve::*under_way);
    ~TaskBeside();
    TaskBeside(const TaskBeside&) = delete;
    TaskBeside& operator=(const TaskBeside&) = delete;

   private:
    LiveSolve& live_;
    bool LiveSolve::*under_way_;
  };
  template <class Save>
  void saving(const std::filesystem::path& path, Save&& save);
  CancelToken loading() const { return CancelToken(*setup_.given_up, &told_); }
  void tell(double done);
  void settle();
  void note(Error problem);
  /// Notes what is being handled.
  void noteException();
  void publish();
  template <class F>
  void forEachLane(F&& f) const {
    for (Lane* lane : {lane_.get(), rival_.get()}) {
      if (lane) f(*lane);
    }
  }

  /// The same where there are any and none of them is broken; throws an Error else, before anything is done.
  template <class F>
  void forEachUsable(F&& f) {
    present();
    forEachLane([](Lane& lane) { lane.checkUsable(); });
    forEachLane(f);
  }

  LiveSolveSetup setup_;
  MemoryReserve reserve_;
  std::unique_ptr<Lane> lane_, rival_;  // rival_: in a race
  bool paused_ = false;
  std::uint64_t steps_left_ = 0;  // before a pause; 0: no pause is due
  InsightWanted insight_;
  std::string task_;  // not empty while loading or in a task beside
  bool saving_ = false, editing_ = false, refining_ = false;
  double loading_began_ = 0, task_began_ = 0, last_told_ = 0;  // wall time
  std::optional<double> gathering_began_, completing_began_;   // wall time
  std::optional<double> task_done_;
  const CancelToken::Told told_ = [this](double done) { tell(done); };
  bool abandoned_ = false;  // what commands that wait may be meant for was given up
  Saver saver_;

  std::uint64_t version_ = 0, epoch_ = 0, commands_ = 0, problems_ = 0;
  std::optional<Error> problem_;
  std::uint64_t saves_ = 0;
  std::filesystem::path saved_as_;
  std::optional<ResumedFrom> resumed_;
};

}  // namespace unshot
