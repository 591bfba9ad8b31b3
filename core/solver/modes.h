// The table of iteration modes. A mode only chooses what is shot next; a new mode is its own file and a row
// here.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "base/choice.h"
#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

/// One way of iterating. It may be created on any state (another mode's, half way), and left at any step.
class IterationMode {
 public:
  virtual ~IterationMode() = default;
  /// One shot: chooses a patch, gets its column, applies it. Returns the patch, or none where nothing is left
  /// to shoot.
  virtual std::optional<std::uint32_t> step(RadiosityState& state, Transport& transport) = 0;
};

struct IterationModeRow {
  ChoiceInfo info;
  std::unique_ptr<IterationMode> (*make)();
};

std::span<const IterationModeRow> iterationModes();

std::unique_ptr<IterationMode> makeSouthwell();
std::unique_ptr<IterationMode> makeJacobi();
std::unique_ptr<IterationMode> makeGaussSeidel();

}  // namespace unshot
