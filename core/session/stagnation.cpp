#include "session/stagnation.h"

#include <cmath>

namespace unshot {
namespace {

// A mode that takes this many passes over all patches without losing this share of the unshot power will not
// arrive.
constexpr std::uint64_t kStagnationPasses = 20;
constexpr double kStagnationShare = 1e-4;

}  // namespace

void StagnationWatch::restart(const Measures& measures) {
  fraction_ = measures.unshot_fraction;
  shots_ = measures.shots;
}

bool StagnationWatch::found(const Measures& measures, std::size_t patches) {
  if (measures.shots - shots_ < kStagnationPasses * patches) return false;
  const bool stands = measures.unshot_fraction > (1 - kStagnationShare) * fraction_;
  restart(measures);
  return stands;
}

bool nothingDiesOut(const RadiosityState& state) {
  double left = 0, reflected = 0;
  for (std::size_t q = 0; q < state.patchCount(); ++q) {
    for (int c = 0; c < 3; ++c) {
      const double power = state.area()[q] * std::abs(state.unshot()[q][c]);
      left += power;
      if (state.reflectance()[q][c] >= 1) reflected += power;
    }
  }
  return reflected >= (1 - kStagnationShare) * left;
}

}  // namespace unshot
