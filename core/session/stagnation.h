// Finds out when a solve does not get anywhere.
#pragma once

#include <cstdint>
#include <functional>

#include "session/snapshot.h"
#include "solver/state.h"

namespace unshot {

class StagnationWatch {
 public:
  /// From here on the unshot power has to fall.
  void restart(const Measures& measures);
  /// Whether it has not fallen over many passes over the patches. `hopeless`: asked once it has not over some
  /// passes; where it says so, they are enough.
  bool found(const Measures& measures, std::size_t patches, const std::function<bool()>& hopeless);

 private:
  double fraction_ = 1;
  std::uint64_t shots_ = 0, looked_ = 0;
};

/// Whether the light still on its way goes from wall to wall that reflects all of it.
bool nothingDiesOut(const RadiosityState& state);

/// Whether what is shot can be light: some mode may solve a system that has no solution to within rounding,
/// by values below zero or by far more than bounces could make of what is emitted.
bool isLight(const RadiosityState& state);

}  // namespace unshot
