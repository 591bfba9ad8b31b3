// The first sweep of a mode that needs every column: until all are computed there is light to show, so each
// patch shoots what it holds once, the brightest first. Emission is all shot afterwards.
#pragma once

#include <vector>

#include "solver/state.h"

namespace unshot {

class FirstPass {
 public:
  /// Shoots one patch; false where none is left: each has shot, holds nothing, or has shot before
  /// along a column at hand.
  bool step(RadiosityState& state, Transport& transport);

 private:
  std::vector<char> passed_;
  bool over_ = false;
};

}  // namespace unshot
