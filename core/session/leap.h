// Many shots at once: what patches whose columns are at hand send to each other, bounce after bounce.
//
// Shot by shot it would go along each of their columns again and again. The sum of the bounces is worked out
// among patches, where a product is cheap (PatchMatrix), and then sent along each column once. Bounce by
// bounce nothing is sent that is not unshot, so that what is unshot keeps its sign.
#pragma once

#include <cstddef>

#include "formfactor/transport.h"
#include "solver/light_flow.h"
#include "solver/patch_matrix.h"
#include "solver/state.h"

namespace unshot {

/// Whether a product with it takes no more than a millisecond or two.
bool canLeapBy(const PatchMatrix& matrix);

class Leap {
 public:
  /// Starts anew from the present state, which is not to change before the end. What an emitter has not sent
  /// of its own light goes another way. Takes some products with the matrix.
  void begin(const PatchMatrix& matrix, const RadiosityState& state, const Transport& transport);
  bool running() const { return running_; }
  /// Goes on for some milliseconds; the last time changes the state. Returns how many columns were used.
  std::size_t advance(RadiosityState& state, Transport& transport);
  /// The one under way comes to no end.
  void abandon() { running_ = false; }

 private:
  TransportProduct product_;
  bool running_ = false;
};

}  // namespace unshot
