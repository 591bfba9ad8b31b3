// How wrong the picture still is, and from which cause, at a small share of the solver's time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "formfactor/transport.h"
#include "session/residuals.h"
#include "solver/bounds.h"
#include "solver/patch_matrix.h"
#include "solver/state.h"

namespace unshot {

class ErrorBudget {
 public:
  /// All outlive the budget. `matrix_bytes`: what the matrix among patches may take. `occlusion`: whether
  /// anything can stand between two points.
  ErrorBudget(const Mesh& mesh, const Transport& transport, const RadiosityState& state,
              std::size_t matrix_bytes, bool occlusion, std::uint64_t seed);

  /// To be called with each column of the transport, new or better.
  void columnComputed(std::uint32_t q, const Column& column);
  /// The state shoots again from nothing; the matrix stays.
  void restart();
  /// The bounds of the present state, after `shots` shots. They are worked out more sharply as often as a
  /// small share of the solver's work allows, counted in operations, so that a solve is the same each time.
  const SolverBounds& update(std::uint64_t shots);
  /// The bounds as sharp as they get, whatever it takes (a few sweeps).
  const SolverBounds& sharpen();
  const ErrorBounds& bounds() const { return bounds_; }
  const PatchMatrix& matrix() const { return matrix_; }
  /// As PatchMatrix::allowFewerChannels.
  void allowFewerChannels(bool allowed) { matrix_.allowFewerChannels(allowed); }
  /// The first estimate may go by these places, as far as it asks for so many (ResidualPlaces::restore).
  void offerPlaces(std::vector<ResidualPlace> places) { offered_ = std::move(places); }
  /// Estimates of what form factors and mesh leave wrong, from so many more places than before.
  /// `shown`: H as it is shown.
  const ErrorEstimates& estimate(std::size_t more_places, const MeshField& shown);
  const ErrorEstimates& estimates() const { return estimates_; }
  /// The next estimate is from places of its own alone, chosen by the light as it is then.
  void forgetPlaces();
  std::size_t places() const { return residuals_ ? residuals_->places() : 0; }
  /// See Residuals::patchResiduals; empty before the first estimate.
  std::vector<double> patchResiduals(const MeshField& shown) const;
  double seconds() const { return seconds_; }  ///< wall time that it took so far
  std::size_t bytes() const { return matrix_.bytes(); }

 private:
  bool matrixIsNearlyWhole() const;

  const Mesh& mesh_;
  const Transport& transport_;
  const RadiosityState& state_;
  bool occlusion_;
  std::uint64_t seed_;
  PatchMatrix matrix_;
  ErrorBounds bounds_;
  SolverBounds now_;
  std::optional<Residuals> residuals_;
  std::vector<ResidualPlace> offered_;
  ErrorEstimates estimates_;
  FormFactorDefects defects_;
  std::uint64_t defects_version_ = 0;  // of the matrix
  double credit_ = 0;                  // operations that the solver's work allows
  std::uint64_t shots_ = 0;
  std::size_t refreshed_count_ = 0;
  std::uint64_t refreshed_version_ = ~std::uint64_t{0};
  std::uint64_t last_version_ = 0;
  bool gains_ = true;
  int sharpenings_ = 0;  // since the last refresh
  double seconds_ = 0;
};

}  // namespace unshot
