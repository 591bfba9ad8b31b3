// The exact solution of a solve's discrete system, once the mode `direct` has found it: what the error of
// any other mode is measured against.
#pragma once

#include <optional>
#include <vector>

#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

class KnownSolution {
 public:
  /// Takes B = S + U of a state that is solved to rounding.
  void learn(const RadiosityState& state, const Transport& transport);
  bool known(const Transport& transport) const {
    return !radiosity_.empty() && replaced_ == transport.replaced();
  }
  /// RMS of B - B* over RMS of B* - E, where errors count (solver/counted.h), weighted by
  /// area, over channels: what SolverBounds::upper bounds. Nothing where the solution is not known, or is
  /// that of drafts that have been replaced since.
  std::optional<double> errorOf(const RadiosityState& state, const Transport& transport) const;

 private:
  std::vector<glm::dvec3> radiosity_;
  std::uint64_t replaced_ = 0;
};

}  // namespace unshot
