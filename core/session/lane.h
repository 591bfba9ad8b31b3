// One solve of a live session and what of it is shown: a session has one, a race two.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "session/looking_on.h"
#include "session/publish_pace.h"
#include "session/session.h"

namespace unshot {

/// All calls on the solver thread.
class Lane {
 public:
  /// Makes the first snapshot. `asked` are the options to show, `note` takes what fails later.
  Lane(std::unique_ptr<Solve> solve, SolveOptions asked, double load_seconds,
       std::function<void(Error)> note);

  const Solve& solve() const { return *solve_; }
  const SolveFacts& facts() const { return *facts_; }
  const std::shared_ptr<const Mesh>& mesh() const { return snapshot_->mesh; }
  /// What a step threw: the solve takes no more and gives no more snapshots.
  bool broken() const { return broken_.has_value(); }
  /// Whether step() has something to do.
  bool running() const { return !broken() && active().state() == SolveState::kRunning; }
  SessionPhase phase(bool paused) const;

  /// Throws an Error where the solve is broken.
  void checkUsable() const;
  // These throw it too, or where the solve refuses.
  void setMode(const std::string& key);
  void setError(double error);
  void again();
  void edit(const std::vector<Material>& materials, const std::function<gl::Context&()>& gl,
            const CancelToken& cancel);
  void completeBounces(bool wanted);
  /// Whether the solve rests on a mesh that is too coarse for the error asked for (Solve::finerMeshError).
  bool wantsFinerMesh() const;
  /// Begins to go on on a finer mesh: it runs again, and shows what there was until that has converged.
  /// Throws what Solve does; then it rests as before, and wants no more.
  void refineMesh(const std::function<gl::Context&()>& gl, const CancelToken& cancel);
  /// What state() tells beside the snapshot from now on.
  void lookInto(const InsightWanted& wanted);

  /// One step (Solve::step), after which estimates may be made too.
  void step(std::uint64_t most_shots = Solve::kMostAtOnce);
  /// Wall time that bounds and estimates took while it ran, since it last began with nothing shot: less than
  /// a tenth of measures().seconds, the bounds as often as they come and estimates with a share of their own.
  double errorSeconds() const { return bound_seconds_ + estimate_seconds_; }
  /// Stops the clocks of the solve until its next step.
  void rest() { active().rest(); }
  /// Tells of a solve that has failed, once.
  void noteFailure();

  /// Whether estimates or light by bounces get better while nothing is shot.
  bool hasSpareWork() const;
  /// How much of the matrix that is looked into is gathered; none where none is under way.
  std::optional<double> gathering() const {
    return looking_on_ && looking_on_->hasWork() ? looking_on_->gathering() : std::nullopt;
  }
  /// How much of what completeBounces() asked for is computed; none where nothing of it is left.
  std::optional<double> completing() const;
  /// Light by bounces, then errors estimated from more places, and the sums of rows. Returns whether that is
  /// to be shown now.
  bool spareWork(double interval);

  /// Whether a snapshot of a lane under way is due.
  bool due(double interval) const;
  /// Makes what is shown anew where it is stale: a snapshot of a lane at rest, or where one is due.
  void refresh(bool resting, double interval);
  LaneState state(bool resting, bool paused) const;

 private:
  Solve& usable();
  Solve& active() { return finer_ ? *finer_ : *solve_; }
  const Solve& active() const { return finer_ ? *finer_ : *solve_; }
  void forgetFinerMesh();
  void takeFinerMesh();
  void learnFacts(SolveOptions asked, double load_seconds);
  void noteException() { note_(presentError()); }
  bool hasLight() const;
  bool hasBounceWork() const;
  bool completesBounces() const;
  bool workOutBounces(double interval);
  bool sumRows();
  bool gather();
  void refreshInsight(bool at_once);
  void estimateInPassing();
  void estimateFrom(std::size_t more_places);
  bool wantsSnapshot(bool resting, double interval) const;

  std::unique_ptr<Solve> solve_;
  std::unique_ptr<Solve> finer_;         // on a finer mesh: takes solve_'s place when it has converged
  bool no_finer_mesh_ = false;           // it was given up, or failed
  std::optional<LookingOn> looking_on_;  // once that was asked for
  std::function<void(Error)> note_;
  std::optional<std::string> broken_;
  bool failure_noted_ = false;  // numerical trouble is told once
  PublishPace pace_;
  bool stale_ = false;            // the solve has gone on since the snapshot
  bool estimates_stale_ = false;  // and since the estimates
  bool places_in_passing_ = false;
  double bound_seconds_ = 0, estimate_seconds_ = 0, last_estimate_seconds_ = 0;
  bool no_more_places_ = false;                              // the scene has none, or estimating failed
  bool complete_bounces_ = false, no_more_bounces_ = false;  // asked for; working them out failed

  std::size_t most_missing_ = 0;  // columns, since they were asked for

  std::shared_ptr<const std::vector<std::uint32_t>> surface_lines_;
  std::shared_ptr<const SolveFacts> facts_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::shared_ptr<const std::vector<HistoryEntry>> history_;
};

}  // namespace unshot
