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
/// at the middles of 32^2 and 64^2 squares a face with exact factors of point and square, and extrapolated:
/// differences fall by 3.0 at each halving. Four digits stand; the sum over the faces, lit + opposite + 4
/// side = 1 / (1 - rho), holds exactly.
std::span<const LitCubeTruth> litCubeTruths();

/// The row of this reflectance, which must be there.
const LitCubeTruth& litCubeTruth(double reflectance);

}  // namespace unshot
