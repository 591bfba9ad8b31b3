// What each command does to the live solve, but for saving.
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "base/clock.h"
#include "scene/obj_reader.h"
#include "session/live_solve.h"
#include "session/saved_solve.h"

namespace unshot {

void LiveSolve::perform(const command::Open& c) {
  std::shared_ptr<SavedSolve> saved;
  SolveOptions options = c.options;
  if (!c.saved.empty()) {
    announce("reading " + c.saved.filename().string());
    saved = readSavedSolve(c.saved, loading());
    if (!c.error_given) options.error = saved->error;
  }
  announce("reading " + c.scene.filename().string());
  const double began = wallSeconds();
  Scene scene = readObj(c.scene, loading());
  begin({.scene = std::move(scene),
         .options = options,
         .load_seconds = wallSeconds() - began,
         .saved = std::move(saved)});
}

void LiveSolve::perform(const command::Restart& c) {
  const Lane& lane = present();
  begin({.scene = lane.solve().scene(),
         .options = c.options,
         .load_seconds = lane.facts().load_seconds,
         .rival_mode = rivalMode()});
}

void LiveSolve::perform(const command::Edit& c) {
  Lane& lane = present();
  Scene edited = editedScene(lane.solve().scene(), c.materials);
  // A race that is fair begins with nothing shot.
  if (!rival_ && !lane.broken() && lane.solve().canEdit(edited.materials)) {
    const TaskBeside task(*this, "changing materials", &LiveSolve::editing_);
    task_done_.reset();
    publish();
    return lane.edit(
        edited.materials, [this]() -> gl::Context& { return context(); }, CancelToken(*setup_.given_up));
  }
  const bool paused = paused_;
  begin({.scene = std::move(edited),
         .options = lane.facts().options,
         .load_seconds = lane.facts().load_seconds,
         .rival_mode = rivalMode()});
  paused_ = paused;
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
  begin({.scene = lane.solve().scene(),
         .options = options,
         .load_seconds = lane.facts().load_seconds,
         .rival_mode = rivalMode(),
         .mesh = lane.mesh()});
}

void LiveSolve::perform(const command::SetError& c) {
  forEachUsable([&](Lane& lane) { lane.setError(c.error); });
}

void LiveSolve::perform(const command::CompleteBounces& c) {
  forEachUsable([&](Lane& lane) { lane.completeBounces(c.wanted); });
}

void LiveSolve::perform(const command::LookInto& c) {
  insight_ = c.wanted;
  if (lane_) lane_->lookInto(insight_);
}

void LiveSolve::perform(const command::ShootAgain&) {
  forEachUsable([](Lane& lane) { lane.again(); });
  resumed_.reset();
  ++epoch_;
}

void LiveSolve::perform(const command::Race& c) {
  const Lane& lane = present();
  begin({.scene = lane.solve().scene(),
         .options = lane.facts().options,
         .load_seconds = lane.facts().load_seconds,
         .rival_mode = c.mode,
         .mesh = lane.mesh()});
}

void LiveSolve::perform(const command::EndRace&) {
  rival_.reset();
  if (!lane_ || !lane_->running()) paused_ = false;
}

}  // namespace unshot
