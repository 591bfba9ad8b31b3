#include "session/live_solve.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "gl/context.h"
#include "session/saved_solve.h"

namespace unshot {
namespace {

// Enough for a state, the messages and the buffers of a save, by far.
constexpr std::size_t kReserve = std::size_t{32} << 20;
// Between two states that tell how far a task is.
constexpr double kTellSeconds = 0.1;

/// Since when [wall time] something goes on, which it may do from now on; 0 where it does not.
double sinceWhen(std::optional<double>& began, bool goes_on) {
  if (!goes_on) began.reset();
  if (goes_on && !began) began = wallSeconds();
  return began.value_or(0);
}

}  // namespace

bool isSuperseded(const Command& command, const Command& later) {
  const bool opens = std::holds_alternative<command::Open>(later);
  if (std::holds_alternative<command::Open>(command) || std::holds_alternative<command::Edit>(command) ||
      std::holds_alternative<command::Race>(command) ||
      std::holds_alternative<command::SetMode>(command))  // in a race it begins anew
    return opens;
  return std::holds_alternative<command::Restart>(command) &&
         (opens || std::holds_alternative<command::Restart>(later));
}

LiveSolve::LiveSolve(LiveSolveSetup setup)
    : setup_(std::move(setup)), reserve_(kReserve), saver_(setup_.kept.path, setup_.kept.every) {}

LiveSolve::~LiveSolve() {
  lane_.reset();  // its GL objects, while the context is still current
  rival_.reset();
  if (setup_.gl) setup_.gl->release();
}

void LiveSolve::carryOut(const Command& command) {
  const bool ran = running();
  try {
    std::visit([this](const auto& c) { perform(c); }, command);
  } catch (const Cancelled&) {
    abandoned_ = abandoned_ || !std::holds_alternative<command::Save>(command);
  } catch (...) {
    noteException();
  }
  task_.clear();
  const auto* const edit = std::get_if<command::Edit>(&command);
  commands_ += edit ? 1 + edit->instead_of : 1;
  if (ran && !running()) offerToSaver();
  settle();
  // Whoever sends more from now on is told what stays.
  if (setup_.none_waits()) abandoned_ = false;
  publish();
}

void LiveSolve::step() {
  if (meshIsToBeRefined()) return refineMesh();
  takeSteps();
  if (running() && steps_left_ > 0 && --steps_left_ == 0) paused_ = true;
  offerToSaver();
  settle();
  bool due = true;
  forEachLane([&](const Lane& lane) { due = due && (!lane.running() || lane.due(*setup_.interval)); });
  if (due || !running()) publish();
}

// In a race the clock of one rests while the other takes its step; steps that were asked for are taken by
// both.
void LiveSolve::takeSteps() {
  const auto seconds = [](const Lane& lane) { return lane.solve().measures().seconds; };
  Lane* behind = nullptr;
  forEachLane([&](Lane& lane) {
    if (lane.running() && (!behind || seconds(lane) < seconds(*behind))) behind = &lane;
  });
  const std::uint64_t cut = lane_->mesh()->cut;
  forEachLane([&](Lane& lane) {
    if (!lane.running() || (steps_left_ == 0 && &lane != behind)) return;
    lane.step(steps_left_ > 0 ? 1 : Solve::kMostAtOnce);
    if (rival_) lane.rest();
  });
  if (lane_->solve().mesh().cut == cut) return;
  lane_->lookInto(insight_);
  ++epoch_;
}

// In a race both are on one mesh.
bool LiveSolve::meshIsToBeRefined() const { return lane_ && !rival_ && lane_->wantsFinerMesh(); }

bool LiveSolve::hasSpareWork() const {
  if (running() || !task_.empty()) return false;
  bool any = false;
  forEachLane([&](const Lane& lane) { any = any || lane.hasSpareWork(); });
  return any;
}

void LiveSolve::spareWork() {
  Lane& lane = lane_->hasSpareWork() ? *lane_ : *rival_;
  const bool news = lane.spareWork(*setup_.interval);
  const bool tells = (lane.gathering() || lane.completing()) && wallSeconds() >= last_told_ + kTellSeconds;
  if (tells) last_told_ = wallSeconds();
  if (news || tells) publish();
}

// What a command was to wait for may be given up later.
void LiveSolve::refineMesh() {
  try {
    const TaskBeside task(*this, "refining the mesh", &LiveSolve::refining_);
    publish();
    lane_->refineMesh([this]() -> gl::Context& { return context(); }, CancelToken(*setup_.given_up, &told_));
  } catch (const Cancelled&) {
  } catch (...) {
    noteException();
  }
  settle();
  publish();
}

void LiveSolve::perform(const command::Save& c) {
  // Another scene than the one that was meant.
  if (abandoned_) {
    throw Error(ErrorKind::kUsage, "the solve that was to be saved had not begun, and was given up",
                c.path.string(), "saving it once it is shown");
  }
  Lane& lane = present();
  lane.checkUsable();
  saving(c.path, [&](const CancelToken& cancel) { lane.solve().save(c.path, cancel); });
  ++saves_;
  saved_as_ = c.path;
}

/// Of another scene, opened later, nothing goes into the file.
bool LiveSolve::isKept() const {
  return lane_ && !setup_.kept.path.empty() && lane_->facts().scene_path == setup_.kept.scene;
}

void LiveSolve::offerToSaver() {
  const bool at_rest = !running();
  if (!isKept() || lane_->broken() || !saver_.due(at_rest)) return;
  saving(setup_.kept.path, [&](const CancelToken& cancel) {
    if (std::optional<Error> failed = saver_.offer(lane_->solve(), at_rest, cancel))
      note(Error(failed->kind(), failed->what(), failed->where(),
                 failed->advice() + "; the solve goes on, and is saved again later"));
  });
}

void LiveSolve::saveKept() {
  if (!isKept()) return;
  try {
    lane_->checkUsable();
    saving(setup_.kept.path, [&](const CancelToken& cancel) { saver_.save(lane_->solve(), cancel); });
  } catch (const Cancelled&) {
  } catch (...) {
    noteException();
  }
}

void LiveSolve::finish() {
  if (!isKept()) return;
  reserve_.release();
  saveKept();
  publish();
}

void LiveSolve::recover() {
  reserve_.release();
  task_.clear();
  settle();
  publish();
}

SessionPhase LiveSolve::phase() const {
  if (!task_.empty() && !saving_ && !editing_ && !refining_) return SessionPhase::kLoading;
  if (!lane_) return SessionPhase::kEmpty;
  if (refining_ || meshIsToBeRefined()) return paused_ ? SessionPhase::kPaused : SessionPhase::kRunning;
  const bool rival_runs = rival_ && rival_->running();
  return (rival_runs ? *rival_ : *lane_).phase(paused_);
}

gl::Context& LiveSolve::context() {
  if (!setup_.gl) {
    throw Error(ErrorKind::kEnvironment, "there is no OpenGL context to draw hemicubes with", {},
                "the form factors 'rays'");
  }
  setup_.gl->makeCurrent();
  return *setup_.gl;
}

Lane& LiveSolve::present() {
  if (!lane_) throw Error(ErrorKind::kUsage, "there is no scene to solve yet", {}, "open one");
  return *lane_;
}

std::optional<std::string> LiveSolve::rivalMode() const {
  return rival_ ? std::optional(rival_->facts().options.mode) : std::nullopt;
}

std::unique_ptr<Lane> LiveSolve::makeLane(Scene scene, const SolveOptions& own, const SolveOptions& asked,
                                          double load_seconds, std::shared_ptr<SavedSolve> saved) {
  auto solve = std::make_unique<Solve>(
      std::move(scene), own, [this]() -> gl::Context& { return context(); }, loading(), std::move(saved));
  loading().check();
  return std::make_unique<Lane>(std::move(solve), asked, load_seconds,
                                [this](Error problem) { note(std::move(problem)); });
}

// What is new takes the old one's place only when it stands and has its first snapshots.
void LiveSolve::begin(Start start) {
  loading().check();
  announce("meshing " + start.scene.path.filename().string());
  const bool another_scene = isKept() && start.scene.path != setup_.kept.scene;
  SolveOptions own = start.options, asked = start.options;
  own.mesh = std::move(start.mesh);
  // The window has a core for itself.
  if (own.threads == 0) own.threads = std::max(2u, std::thread::hardware_concurrency()) - 1;
  if (start.saved) {
    asked = start.saved->options(asked);
    asked.mesh.reset();  // a restart cuts it as it is asked to then
  }
  std::optional<ResumedFrom> resumed;
  if (start.saved) resumed = {start.saved->path, start.saved->shots, start.saved->seconds};
  std::unique_ptr<Lane> fresh, rival;
  if (!start.rival_mode) {
    fresh = makeLane(std::move(start.scene), own, asked, start.load_seconds, std::move(start.saved));
  } else {
    own.sharers = 2;
    fresh = makeLane(start.scene, own, asked, start.load_seconds);
    own.mode = asked.mode = *start.rival_mode;
    own.mesh = fresh->mesh();
    rival = makeLane(std::move(start.scene), own, asked, start.load_seconds);
    fresh->rest();
    rival->rest();
  }
  if (another_scene) saveKept();
  lane_ = std::move(fresh);
  lane_->lookInto(insight_);
  rival_ = std::move(rival);
  resumed_ = std::move(resumed);
  reserve_.refill();
  paused_ = false;
  steps_left_ = 0;
  ++epoch_;
}

void LiveSolve::announce(const std::string& task) {
  abandoned_ = false;
  forEachLane([](Lane& lane) { lane.rest(); });
  const double now = wallSeconds();
  if (task_.empty()) loading_began_ = now;
  task_ = task;
  task_done_ = 0;
  task_began_ = last_told_ = now;
  publish();
}

LiveSolve::TaskBeside::TaskBeside(LiveSolve& live, std::string task, bool LiveSolve::*under_way)
    : live_(live), under_way_(under_way) {
  live.forEachLane([](Lane& lane) { lane.rest(); });
  live.task_ = std::move(task);
  live.*under_way = true;
  live.task_done_ = 0;
  live.task_began_ = live.last_told_ = wallSeconds();
}

LiveSolve::TaskBeside::~TaskBeside() {
  live_.task_.clear();
  live_.*under_way_ = false;
}

/// Saves, and tells how far that is where it takes a while.
template <class Save>
void LiveSolve::saving(const std::filesystem::path& path, Save&& save) {
  *setup_.save_given_up = false;
  const TaskBeside task(*this, "saving " + path.filename().string(), &LiveSolve::saving_);
  save(CancelToken(*setup_.save_given_up, &told_));
}

void LiveSolve::tell(double done) {
  const double now = wallSeconds();
  if (task_.empty() || now < last_told_ + kTellSeconds) return;
  last_told_ = now;
  task_done_ = std::max(task_done_.value_or(0), done);
  publish();
}

// What follows from a phase, once it is known.
void LiveSolve::settle() {
  const bool going = running();
  forEachLane([&](Lane& lane) {
    if (!going || !lane.running()) lane.rest();
    if (!lane.running()) lane.noteFailure();
  });
  if (!going && phase() != SessionPhase::kPaused) steps_left_ = 0;
}

void LiveSolve::noteException() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    reserve_.release();  // the message needs memory
  } catch (...) {
  }
  note(presentError());
}

void LiveSolve::note(Error problem) {
  ++problems_;
  problem_ = std::move(problem);
}

void LiveSolve::publish() {
  const bool going = running();
  auto state = std::make_shared<SessionState>();
  if (task_.empty())
    forEachLane([&](Lane& lane) { lane.refresh(!going || !lane.running(), *setup_.interval); });
  const bool rests = !going && task_.empty();
  if (lane_) static_cast<LaneState&>(*state) = lane_->state(rests, paused_);
  if (rival_) state->rival = rival_->state(rests, paused_);
  state->version = ++version_;
  state->epoch = epoch_;
  state->commands = commands_;
  state->phase = phase();
  state->task = task_;
  if (!task_.empty()) state->task_done = task_done_;
  state->task_began = task_began_;
  state->loading_began = loading_began_;
  state->gathering_began = sinceWhen(gathering_began_, state->gathering.has_value());
  state->completing_began = sinceWhen(completing_began_, state->completing.has_value());
  state->saving = saving_;
  state->editing = editing_;
  state->refining = refining_;
  state->finer_mesh = !rival_ && (state->finer_mesh || refining_);
  state->resumed = resumed_;
  state->problems = problems_;
  state->problem = problem_;
  state->saves = saves_;
  state->saved_as = saved_as_;
  setup_.publish(std::move(state));
}

}  // namespace unshot
