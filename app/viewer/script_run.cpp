// The viewer's script: what of it is due, and when it waits.
#include "viewer/actions/actions.h"
#include "viewer/teaching.h"
#include "viewer/viewer.h"

namespace unshot {

bool Viewer::settled() const {
  return session_.sent() == state_->commands && state_->phase != SessionPhase::kLoading &&
         !(frame_wanted_ && !snapshotRefused()) && !scene_.framing() && !waitsForFiles() &&
         !state_->spareWork() && teaching_->settled();
}

bool Viewer::waitIsOver(const ScriptLine& line, double now) {
  if (wait_began_ < 0) wait_began_ = now;
  if (session_.sent() != state_->commands) return false;
  const SessionPhase phase = state_->phase;
  if (phase != SessionPhase::kRunning && phase != SessionPhase::kLoading && phase != SessionPhase::kPaused)
    return true;
  if (line.wait == WaitFor::kSeconds) return now >= wait_began_ + line.amount;
  // Paused, nothing will happen any more.
  if (phase == SessionPhase::kPaused) return true;
  return line.wait == WaitFor::kShots && phase == SessionPhase::kRunning &&
         static_cast<double>(state_->measures.shots) >= line.amount;
}

// What stands between two waits happens at once: no shot falls between `restart` and `pause on`.
void Viewer::runScript(double now) {
  if (scriptDone()) return;
  if (!hold_) hold_.emplace(session_);
  runScriptLines(now);
  hold_.reset();
}

void Viewer::runScriptLines(double now) {
  while (script_at_ < script_.size() && !closing_ && !waitsForFiles() && !pick_wanted_) {
    const ScriptLine& line = script_[script_at_];
    if (line.wait != WaitFor::kNothing) {
      if (!waitIsOver(line, now)) return;
      wait_began_ = -1;
    } else {
      if (findAction(line.action).when_settled && !settled()) {
        // A scene that cannot be opened leaves nothing to settle.
        const bool nothing = session_.sent() == state_->commands && state_->phase == SessionPhase::kEmpty;
        if (!nothing) return;
      }
      perform(line.action, line.argument);
    }
    ++script_at_;
  }
}

}  // namespace unshot
