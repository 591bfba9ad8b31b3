#include "session/draft_refinement.h"

#include <utility>

#include "solver/brightness.h"

namespace unshot {
namespace {

ColumnQuality leastQuality(const Transport& transport) {
  return transport.count(ColumnQuality::kGroup) > 0 ? ColumnQuality::kGroup : ColumnQuality::kOnePoint;
}

}  // namespace

bool DraftRefinement::due(const Transport& transport, bool reached) {
  const std::optional<ColumnQuality> before = std::exchange(giving_way_, std::nullopt);
  if (transport.draftCount() == 0) return false;
  const ColumnQuality least = leastQuality(transport);
  if (reached || before == least) giving_way_ = least;
  return giving_way_.has_value();
}

void DraftRefinement::step(Transport& transport, RadiosityState& state) {
  transport.allowDrafts(false);
  const ColumnQuality least = leastQuality(transport);
  std::uint32_t brightest = kNone;
  double most = -1;
  for (std::uint32_t q = 0; q < state.patchCount(); ++q) {
    if (transport.quality(q) != least) continue;
    const double power = powerOf(state.area()[q], state.shot()[q]);
    if (power <= most) continue;
    most = power;
    brightest = q;
  }
  const auto [draft, column] = transport.refine(brightest);
  state.replaceColumn(brightest, draft, column);
}

}  // namespace unshot
