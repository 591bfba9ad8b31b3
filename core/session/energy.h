// Where the emitted power of a solve is.
#pragma once

#include <algorithm>
#include <cmath>

#include "formfactor/transport.h"
#include "solver/state.h"

namespace unshot {

/// Energy of a solve [W], summed over channels: emitted = absorbed + escaped + unshot (+ closure_defect).
struct EnergyBalance {
  double emitted = 0;         ///< sum A E
  double absorbed = 0;        ///< sum A (1 - rho) H
  double escaped = 0;         ///< shot, and met no surface
  double unshot = 0;          ///< sum A U
  double closure_defect = 0;  ///< shot, but lost or gained by approximate form factors
  double residual() const { return emitted - absorbed - escaped - unshot - closure_defect; }
  /// What the terms are summed up from at least, which is what rounding is relative to.
  double size() const {
    return std::max(emitted,
                    std::abs(absorbed) + std::abs(escaped) + std::abs(unshot) + std::abs(closure_defect));
  }
};

EnergyBalance energyOf(const Transport& transport, const RadiosityState& state);

}  // namespace unshot
