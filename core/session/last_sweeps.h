// The end of a solve: what is still unshot goes once more along the columns at hand.
//
// Shot by shot, the last bounces are left out all over the scene, so that the picture is too dark by as much
// as the solver's error allows. All columns that were asked for are kept, and a sweep over them, of minimal
// residual, costs no more than a few of them did.
#pragma once

#include <cstdint>

#include "formfactor/transport.h"
#include "solver/light_flow.h"
#include "solver/minimal_residual.h"
#include "solver/state.h"

namespace unshot {

class LastSweeps {
 public:
  void begin() { left_ = kSweeps; }
  bool running() const { return left_ > 0; }
  /// Goes on for some milliseconds. Returns how many columns were used.
  std::size_t advance(RadiosityState& state, Transport& transport);

 private:
  // Each leaves about a third.
  static constexpr int kSweeps = 2;

  TransportProduct product_;
  MinimalResidual minimal_;
  int left_ = 0;
};

}  // namespace unshot
