#include "session/live_solve.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/clock.h"
#include "gl/context.h"
#include "scene/obj_reader.h"

namespace unshot {

bool isSuperseded(const Command& command, const Command& later) {
  const bool opens = std::holds_alternative<command::Open>(later);
  if (std::holds_alternative<command::Open>(command) || std::holds_alternative<command::Race>(command) ||
      std::holds_alternative<command::SetMode>(command))  // in a race it begins anew
    return opens;
  return std::holds_alternative<command::Restart>(command) &&
         (opens || std::holds_alternative<command::Restart>(later));
}

LiveSolve::LiveSolve(LiveSolveSetup setup) : setup_(std::move(setup)) {}

LiveSolve::~LiveSolve() {
  lane_.reset();  // its GL objects, while the context is still current
  rival_.reset();
  if (setup_.gl) setup_.gl->release();
}

void LiveSolve::carryOut(const Command& command) {
  try {
    std::visit([this](const auto& c) { perform(c); }, command);
  } catch (const Cancelled&) {
  } catch (...) {
    note(presentError());
  }
  task_.clear();
  ++commands_;
  settle();
  publish();
}

void LiveSolve::step() {
  takeSteps();
  if (running() && steps_left_ > 0 && --steps_left_ == 0) paused_ = true;
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
  forEachLane([&](Lane& lane) {
    if (!lane.running() || (steps_left_ == 0 && &lane != behind)) return;
    lane.step(steps_left_ > 0 ? 1 : Solve::kMostAtOnce);
    if (rival_) lane.rest();
  });
}

bool LiveSolve::hasSpareWork() const {
  if (running() || !task_.empty()) return false;
  bool any = false;
  forEachLane([&](const Lane& lane) { any = any || lane.hasSpareWork(); });
  return any;
}

void LiveSolve::spareWork() {
  Lane& lane = lane_->hasSpareWork() ? *lane_ : *rival_;
  if (lane.spareWork(*setup_.interval)) publish();
}

void LiveSolve::perform(const command::Open& c) {
  announce("reading " + c.scene.filename().string());
  const double began = wallSeconds();
  Scene scene = readObj(c.scene, setup_.given_up);
  begin(std::move(scene), c.options, wallSeconds() - began, std::nullopt);
}

void LiveSolve::perform(const command::Restart& c) {
  const Lane& lane = present();
  begin(lane.solve().scene(), c.options, lane.facts().load_seconds, rivalMode());
}

void LiveSolve::perform(const command::Pause&) {
  if (!running()) return;
  paused_ = true;
  steps_left_ = 0;
}

void LiveSolve::perform(const command::Resume&) {
  paused_ = false;
  steps_left_ = 0;
}

void LiveSolve::perform(const command::Step& c) {
  if (!running() && phase() != SessionPhase::kPaused) return;
  paused_ = c.shots == 0 && steps_left_ == 0;
  steps_left_ += std::min(c.shots, std::numeric_limits<std::uint64_t>::max() - steps_left_);
}

void LiveSolve::perform(const command::SetMode& c) {
  if (!rival_) return present().setMode(c.key);
  // A race that is fair begins with nothing shot.
  const Lane& lane = present();
  SolveOptions options = lane.facts().options;
  options.mode = c.key;
  begin(lane.solve().scene(), options, lane.facts().load_seconds, rivalMode(), lane.mesh());
}

void LiveSolve::perform(const command::SetError& c) {
  forEachUsable([&](Lane& lane) { lane.setError(c.error); });
}

void LiveSolve::perform(const command::CompleteBounces&) {
  forEachUsable([](Lane& lane) { lane.completeBounces(); });
}

void LiveSolve::perform(const command::ShootAgain&) {
  forEachUsable([](Lane& lane) { lane.again(); });
  ++epoch_;
}

void LiveSolve::perform(const command::Race& c) {
  const Lane& lane = present();
  begin(lane.solve().scene(), lane.facts().options, lane.facts().load_seconds, c.mode, lane.mesh());
}

void LiveSolve::perform(const command::EndRace&) {
  rival_.reset();
  if (!lane_ || !lane_->running()) paused_ = false;
}

SessionPhase LiveSolve::phase() const {
  if (!task_.empty()) return SessionPhase::kLoading;
  if (!lane_) return SessionPhase::kEmpty;
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
                                          double load_seconds) {
  auto solve = std::make_unique<Solve>(
      std::move(scene), own, [this]() -> gl::Context& { return context(); }, setup_.given_up);
  setup_.given_up.check();
  return std::make_unique<Lane>(std::move(solve), asked, load_seconds,
                                [this](Error problem) { note(std::move(problem)); });
}

// What is new takes the old one's place only when it stands and has its first snapshots. `mesh`: where it is
// at hand.
void LiveSolve::begin(Scene scene, const SolveOptions& options, double load_seconds,
                      const std::optional<std::string>& rival_mode, std::shared_ptr<const Mesh> mesh) {
  setup_.given_up.check();
  announce("meshing " + scene.path.filename().string());
  SolveOptions own = options;
  own.mesh = std::move(mesh);
  std::unique_ptr<Lane> fresh, rival;
  if (!rival_mode) {
    fresh = makeLane(std::move(scene), own, options, load_seconds);
  } else {
    own.sharers = 2;
    fresh = makeLane(scene, own, options, load_seconds);
    SolveOptions asked = options;
    own.mode = asked.mode = *rival_mode;
    own.mesh = fresh->mesh();
    rival = makeLane(std::move(scene), own, asked, load_seconds);
    fresh->rest();
    rival->rest();
  }
  lane_ = std::move(fresh);
  rival_ = std::move(rival);
  paused_ = false;
  steps_left_ = 0;
  ++epoch_;
}

void LiveSolve::announce(const std::string& task) {
  forEachLane([](Lane& lane) { lane.rest(); });
  task_ = task;
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
  state->problems = problems_;
  state->problem = problem_;
  setup_.publish(std::move(state));
}

}  // namespace unshot
