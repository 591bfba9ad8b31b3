// When a solve leaps (leap.h) instead of shooting.
#include <algorithm>

#include "session/solve_impl.h"

namespace unshot {
namespace {

// What a leap costs, for each column that is known.
constexpr double kShotsOfLeap = 0.3;

}  // namespace

// Where a mesh is as fine as the error asks for, all of the light counts.
bool Solve::Impl::endsNearTheTruth() const {
  return mesh->for_error && !options.max_shots && !options.bounces;
}

// Once shots along columns at hand have cost as much as a leap does.
bool Solve::Impl::leapIsDue() const {
  if (leap.running()) return true;
  const PatchMatrix& matrix = budget->matrix();
  return options.mode == "auto" && leavesOut(options.do_anyway, plan_keys::kShots) &&
         mode_key == "southwell" && endsNearTheTruth() && measures.drafts == 0 &&
         static_cast<double>(shots_at_hand) > kShotsOfLeap * static_cast<double>(matrix.knownCount()) &&
         canLeapBy(matrix);
}

bool Solve::Impl::takeLeap() {
  if (!leapIsDue()) return false;
  if (!leap.running()) leap.begin(budget->matrix(), *state, *transport);
  shots_at_hand = 0;
  if (!leap.running()) return false;
  measures.shots += leap.advance(*state, *transport);
  if (!leap.running()) {
    const std::size_t known = std::min<std::size_t>(budget->matrix().knownCount(), mesh->patch_count);
    decide(withoutShots(known, mesh->patch_count, options.error));
  }
  return true;
}

}  // namespace unshot
