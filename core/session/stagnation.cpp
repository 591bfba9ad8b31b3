#include "session/stagnation.h"

#include <algorithm>
#include <cmath>

namespace unshot {
namespace {

// A mode that takes this many passes over all patches without losing this share of the unshot power will not
// arrive where none of it can be lost. Elsewhere what is unshot may stand for longer while it spreads: form
// factors that do not conserve power exactly make up a little of it, until all patches have their share. At a
// reflectance of 0.9999 some forty passes can be without loss; five hundred take 5 % then.
constexpr std::uint64_t kHopelessPasses = 20, kStagnationPasses = 500;
constexpr double kStagnationShare = 1e-4;
// Of what is above zero: what modes that shoot back and forth leave below it.
constexpr double kMostBelow = 0.01;
// More than the form factors' single precision lets light have.
constexpr double kEndlessBounces = 1e6;

}  // namespace

void StagnationWatch::restart(const Measures& measures) {
  fraction_ = measures.unshot_fraction;
  shots_ = looked_ = measures.shots;
}

bool StagnationWatch::found(const Measures& measures, std::size_t patches,
                            const std::function<bool()>& hopeless) {
  if (measures.shots - looked_ < kHopelessPasses * patches) return false;
  if (measures.unshot_fraction <= (1 - kStagnationShare) * fraction_) {
    restart(measures);
    return false;
  }
  looked_ = measures.shots;
  return hopeless() || measures.shots - shots_ >= kStagnationPasses * patches;
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

bool isLight(const RadiosityState& state) {
  for (int c = 0; c < 3; ++c) {
    double shot = 0, below = 0, emitted = 0;
    for (std::size_t q = 0; q < state.patchCount(); ++q) {
      shot += state.area()[q] * std::max(state.shot()[q][c], 0.0);
      below -= state.area()[q] * std::min(state.shot()[q][c], 0.0);
      emitted += state.area()[q] * state.emission()[q][c];
    }
    if (below > kMostBelow * shot || shot > kEndlessBounces * emitted) return false;
  }
  return true;
}

}  // namespace unshot
