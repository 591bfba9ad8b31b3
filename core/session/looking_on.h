// Looks on a solve for a lecture: what session/insight.h lists, worked out anew where it has changed, and no
// oftener than costs a small share of the solver's time.
#pragma once

#include <memory>
#include <vector>

#include "session/gathered_matrix.h"
#include "session/insight.h"
#include "session/publish_pace.h"
#include "session/solve.h"

namespace unshot {

/// On the solve's thread.
class LookingOn {
 public:
  /// `solve` outlives it.
  explicit LookingOn(const Solve& solve);

  /// From now on. What is wanted of another mesh counts as not wanted. The column of the wanted patch must be
  /// at hand, or will not be known (solve_inside.h).
  void want(const InsightWanted& wanted);
  const InsightWanted& wanted() const { return wanted_; }

  /// Around a step that is taken alone: the second tells what it did.
  void beforeStep();
  void afterStep();

  /// Whether the matrix is wanted and can be worked out further while the solve rests.
  bool hasWork() const;
  /// How much of it there is; none where none is under way.
  std::optional<double> gathering() const { return wanted_.matrix ? gatherer_.done() : std::nullopt; }
  /// Goes on with that; returns whether it is complete now.
  bool work() { return gatherer_.advance(); }

  /// Makes what is wanted anew where that is due, or `at_once`.
  void refresh(bool at_once);
  const std::shared_ptr<const Insight>& shown() const { return shown_; }

 private:
  std::shared_ptr<const PatchInsight> lookAt(std::uint32_t patch);
  void findColumn(PatchInsight& out);
  void findRow(std::uint32_t patch);
  std::vector<glm::dvec3> radiosity() const;
  std::uint32_t nextPatch() const;

  const Mesh& mesh_;
  const Transport& transport_;
  const RadiosityState& state_;
  const Measures& measures_;
  InsightWanted wanted_;
  MatrixGatherer gatherer_;
  PublishPace pace_;
  std::vector<glm::dvec3> shot_before_, unshot_before_;
  std::shared_ptr<const ShotInsight> shot_;
  std::shared_ptr<const Insight> shown_;
  // Of the patch looked at last, made of so many columns.
  struct Found {
    std::uint32_t patch = kNone;
    std::uint64_t computed = 0, replaced = 0;
    bool closed = false;
    bool operator==(const Found&) const = default;
  } found_;
  std::vector<PatchShare> shares_;  // of it
  PatchInsight column_;             // what follows from its column alone
  std::vector<float> row_;          // G_ij
  std::size_t missing_ = 0;
};

}  // namespace unshot
