// Exact radiosities of the closed unit cube of one reflectance with one face lit (E = 1).
#pragma once

#include <span>

namespace unshot {

/// Area means of B over the lit face, the one opposite and the four at its sides.
struct LitCubeTruth {
  double reflectance, lit, opposite, side;
};

/// Of the integral equation, not of six patches of one radiosity each, which are up to 6 % off at a
/// reflectance of a half (0.1817 opposite in place of 0.1712). Solved apart from this program, by collocation
/// at the middles of n^2 squares a face with exact factors of point and square, and extrapolated over n:
/// differences fall by 3.0 at each halving. Up to 0.9 with n = 32 and 64; 0.99 with 16 and 32, which 64 bears
/// out; for 0.999 and 0.9999 what the faces differ from their mean, 1 / (6 (1 - rho)), is that of 0.9 and
/// 0.99 extrapolated over rho: it is less than 0.5 % of B there and changes by half a percent of itself. Four
/// digits stand; the sum over the faces, lit + opposite + 4 side = 1 / (1 - rho), holds exactly.
std::span<const LitCubeTruth> litCubeTruths();

/// The row of this reflectance, which must be there.
const LitCubeTruth& litCubeTruth(double reflectance);

}  // namespace unshot
