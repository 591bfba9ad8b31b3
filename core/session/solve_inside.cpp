#include "session/solve_inside.h"

#include "base/clock.h"
#include "session/solve_impl.h"

namespace unshot {

void Solve::Impl::computeKeptColumn(std::uint32_t q) {
  if (transport->isKept(q)) return;
  const double cpu_began = cpuSeconds();
  resting = true;
  transport->column(q);
  measures.rows = transport->computed() - rows_before;
  seconds.cpu_solve += cpuSeconds() - cpu_began;
}

const Transport& transportOf(const Solve& solve) { return insideTransport(solve); }
const RadiosityState& stateOf(const Solve& solve) { return insideState(solve); }
void computeColumn(Solve& solve, std::uint32_t q) { computeInside(solve, q); }

}  // namespace unshot
