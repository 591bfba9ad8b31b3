// The inside of a solve, for those that look on between two steps. On the solve's thread.
#pragma once

#include <cstdint>

#include "session/solve.h"
#include "solver/state.h"

namespace unshot {

const Transport& transportOf(const Solve& solve);
const RadiosityState& stateOf(const Solve& solve);
/// Computes column q of K where it is not at hand; it is kept like those that were shot along. The clocks
/// rest.
void computeColumn(Solve& solve, std::uint32_t q);

}  // namespace unshot
