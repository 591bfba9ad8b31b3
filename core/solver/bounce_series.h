// Light by bounces, the terms of B = E + M E + M^2 E + ...: B_0 = E, and B_k = R rho K B_(k-1) is what bounce
// k adds. K is only read, from columns that are kept; each bounce is one product with it.
//
// The power of a bounce over that of the one before tends to the spectral radius of M (power method; Varga,
// Matrix Iterative Analysis, 9.1). What bounces after the last one known add is left out.
#pragma once

#include <vector>

#include "solver/light_flow.h"
#include "solver/state.h"

namespace unshot {

/// sum A |x| of a field of patches, per channel [W].
glm::dvec3 powerOf(const RadiosityState& state, const std::vector<glm::dvec3>& x);

class BounceSeries {
 public:
  /// Bounces that are worked out at most.
  static constexpr std::size_t kMost = 16;

  /// Both outlive the series. Nothing of the state but E, rho and what light reaches is used.
  BounceSeries(Transport& transport, const RadiosityState& state);

  /// Patches that hold light and whose columns are not kept, as far as is known; none may be missing for a
  /// bounce to be worked out.
  std::vector<std::uint32_t> missing() const;
  /// Forgets all where columns are others than those used; returns whether.
  bool follow();
  /// Goes on for some milliseconds, with columns at hand only. Returns whether one more bounce is known.
  bool advance();
  /// Nothing is left to be worked out: kMost bounces are known, or the last holds hardly anything.
  bool done() const;

  /// sum A B_k per channel [W], of B_0 = E and each bounce that is known; empty before advance().
  const std::vector<glm::dvec3>& powers() const { return powers_; }
  /// H = K (B_0 + ... + B_(n-1)), one per receiver [W/m^2], of the n bounces that are known: E + rho H is the
  /// light of n bounces.
  const std::vector<glm::dvec3>& received() const { return received_; }

 private:
  std::uint64_t version() const { return transport_.computed() + transport_.replaced(); }

  Transport& transport_;
  const RadiosityState& state_;
  std::uint64_t version_ = 0;  // of the columns used
  std::vector<glm::dvec3> powers_, received_, bounce_;
  TransportProduct product_;
};

}  // namespace unshot
