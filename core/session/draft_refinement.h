// When drafts of form factors give way to better columns, and which first.
#pragma once

#include <optional>

#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

class DraftRefinement {
 public:
  /// Whether a draft is to be replaced now: once the error is reached with drafts (`reached`), all of the
  /// least quality give way, one a step, before the mode goes on with what that brought.
  bool due(const Transport& transport, bool reached);
  /// Of the drafts of the least quality, of which there must be one, that whose patch has shot the most power
  /// gives way to the next better column; columns that are new from now on are full. H and U follow, S stays.
  void step(Transport& transport, RadiosityState& state);

 private:
  std::optional<ColumnQuality> giving_way_;  // drafts of this quality
};

}  // namespace unshot
