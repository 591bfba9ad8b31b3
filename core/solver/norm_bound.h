// A bound of the error in the mean square, which sees that unshot light of both signs cancels.
//
// With D = diag(A / rho), N = D^1/2 M D^-1/2 is symmetric where form factors are reciprocal, so its 2-norm nu
// is near its spectral radius, and r = (I - M)^-1 M y has |D^1/2 r| <= nu / (1 - nu) |D^1/2 y|. nu itself is
// bounded by a test that needs no symmetry: for every x > 0, nu^2 <= max (N^T N x) / x (Schur's test; Horn
// and Johnson, Matrix Analysis, 8.1.26).
#pragma once

#include <vector>

#include "solver/patch_matrix.h"
#include "solver/state.h"

namespace unshot {

class NormBound {
 public:
  /// Both outlive it; `matrix` is that of the state's transport.
  NormBound(const PatchMatrix& matrix, const RadiosityState& state);

  /// Bounds nu for the matrix as it is now, all of whose columns that matter are known: better with each
  /// call, by four products.
  void refresh();
  /// At most this, per channel: nu.
  const glm::dvec3& norm() const { return norm_; }
  /// What |D^1/2 y|^2 is summed up with, one per patch: A / rho; next to infinite where rho is 0.
  const std::vector<glm::dvec3>& weights() const { return weights_; }
  /// sum A r^2 over patches and channels is at most this, r = (I - M)^-1 M y, `squares` = |D^1/2 y|^2 per
  /// channel; infinite where nothing is known.
  double squaresAfter(const glm::dvec3& squares) const;

 private:
  const PatchMatrix& matrix_;
  const RadiosityState& state_;
  glm::dvec3 most_reflectance_{0.0}, norm_;
  std::uint64_t version_ = ~std::uint64_t{0};  // of the matrix that norm_ belongs to
  std::vector<glm::dvec3> weights_;
  std::vector<glm::dvec3> x_;  // towards the first singular vector, positive where rho is
};

}  // namespace unshot
