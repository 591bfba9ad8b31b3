// How far the state of a solve is from the exact solution of its discrete system: bounds, at every step, for
// any sign of U, walls of reflectance 1 and form factors that are not reciprocal.
//
// With e = B* - B the error of the patches' radiosity (B = S + U), e = (I - M)^-1 M U.
//
// Total: with weights z >= M^T (1 + z), sum A |e| <= sum A |U| z. M^T is known as far as columns are; in the
// place of an unknown one stands what it could reflect at most if it sends no more of its light than nearly
// all that are known do (PatchMatrix::usuallySent: 1 but for approximation), so that there is a bound from
// the first shot on. An iteration z <- M^T (1 + z) keeps the inequality and lowers z. Weights y <= M^T (1 +
// y), raised from 0 along the columns that are known, bound it from below: sum A e >= sum A max(U, 0) y - sum
// A max(-U, 0) z.
//
// Per patch, once all columns that matter are known: with v > 0 and w = v - M v > 0, |e| <= (v - w) max |U| /
// w (comparison; Varga, Matrix Iterative Analysis, 3.5). v is near the solution of (I - M) v = 1: the
// expected number of patches that light leaving a patch meets, itself included. Powers of M on |U| sharpen
// it. In the mean square, NormBound bounds it without taking |U|. The smallest counts, as far as it was
// tried.
//
// Errors count where solver/counted.h says, and on all patches where no light comes there; weighted by area,
// over channels.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "solver/norm_bound.h"
#include "solver/patch_matrix.h"
#include "solver/state.h"

namespace unshot {

inline constexpr double kNoBound = std::numeric_limits<double>::infinity();

struct SolverBounds {
  double total_upper = kNoBound;  ///< sum A |e| / sum A (B* - E) is at most this
  double total_lower = 0;         ///< and at least this
  double upper = kNoBound;        ///< RMS e / RMS (B* - E) is at most this
  double lower = 0;               ///< and at least this; above 0 only where U >= 0

  /// Of two bounds of the same state.
  static SolverBounds tighter(const SolverBounds& a, const SolverBounds& b) {
    return {std::min(a.total_upper, b.total_upper), std::max(a.total_lower, b.total_lower),
            std::min(a.upper, b.upper), std::max(a.lower, b.lower)};
  }
};

class ErrorBounds {
 public:
  /// Both outlive the bounds; `matrix` is that of the state's transport.
  ErrorBounds(const PatchMatrix& matrix, const RadiosityState& state);

  /// Column q of the matrix is new or better than before.
  void columnChanged(std::uint32_t q);
  /// Takes up what the matrix has learnt and lowers the weights; some products with the matrix. Returns
  /// whether another call would gain.
  bool refresh();
  /// The bounds of the present state; passes over the patches. Of the ways to bound the RMS error it takes
  /// the one that was sharpest when all were last tried, every so many calls.
  SolverBounds at();
  /// Sharper, by `products` products with the matrix.
  SolverBounds sharpened(int products);

  /// Whether all columns that matter are known, so that there may be a bound per patch.
  bool complete() const { return complete_; }
  /// Whether there is a bound per patch for the matrix as it is now.
  bool comparable() const { return !v_.empty() && compared_version_ == matrix_.version(); }
  /// v, one per patch; empty where there is none.
  const std::vector<glm::dvec3>& expectedBounces() const { return v_; }
  /// One more whenever expectedBounces() has changed.
  std::uint64_t revision() const { return revision_; }
  /// Lower and upper bound of the spectral radius of M, per channel (Collatz and Wielandt); once complete.
  const glm::dvec3& spectralRadiusLower() const { return radius_lower_; }
  const glm::dvec3& spectralRadiusUpper() const { return radius_upper_; }

 private:
  using Field = std::vector<glm::dvec3>;

  bool allColumnsThatMatter() const;
  void multiply(const Field& x, Field& out) const;
  Field reflected(Field x) const;
  Field countedPlus(const Field& z) const;
  void count(std::vector<char> counted);
  void countEmittersWhereNoLightLeaves();
  void transposed(const Field& reflected, Field& out) const;
  void capTotal();
  void setTotal(Field z);
  void startTotal();
  bool lowerTotal();
  void raiseTotal();
  void startComparison();
  bool lowerComparison();
  void bracketRadius();
  double rmsCounted(const Field& x) const;
  double rmsOf(double squares) const;
  // Over patches: what bounds are made of.
  struct Sums {
    double weighted = 0, negative = 0;  // A |U| z, A max(-U, 0) z
    double arriving = 0;                // A max(U, 0) y
    double reflected = 0, reflected_squares = 0;
    bool signs() const { return negative > 0; }
  };
  Sums sumsNow() const;
  void weightTotals();
  double totalUpper(const Sums& sums) const;
  double totalLower(const Sums& sums) const;
  double upperOf(double rms, const Sums& sums) const;
  // The ways to bound the RMS error.
  enum class Way { kComparison, kNorm, kAdapted, kNearby };
  static constexpr Way kWays[] = {Way::kComparison, Way::kNorm, Way::kAdapted, Way::kNearby};
  double rmsBy(Way way) const;
  double tryAllWays();
  // Of a pair v, w = v - M v > 0: |e| <= (v - w) max |U| / w.
  struct Comparison {
    Field inverse_w;
    glm::dvec3 squares{0.0};  // sum A (v - w)^2 where errors count
    void set(const Field& v, const Field& w, const ErrorBounds& bounds);
    double rmsAfter(const Field& u, const ErrorBounds& bounds) const;
  };

  const PatchMatrix& matrix_;
  const RadiosityState& state_;
  std::vector<char> counted_;         // patches on which errors count
  std::vector<double> area_counted_;  // A there, 0 elsewhere
  double counted_area_ = 0;
  bool emitters_count_ = false;  // some of them
  std::uint64_t revision_ = 0;
  bool complete_ = false;
  std::uint64_t version_ = 0;                           // of the matrix at the last refresh
  std::uint64_t compared_version_ = ~std::uint64_t{0};  // of the matrix that w_ belongs to
  double sent_ = 1;                                     // of its light by an unknown column
  Field z_;                                             // empty: no bound
  Field reflected_total_;                               // rho (z + 1 where errors count)
  Field y_;                                             // below z
  // A z, rounded up, and A y, rounded down, with A over the area that counts; channels follow each other.
  std::vector<float> upper_weights_, lower_weights_;
  bool weights_stale_ = true;
  Field v_, w_, spectral_;
  Comparison compared_, adapted_;  // of v_ and w_; of the shape of U at the last sharpening
  NormBound norm_;
  // B + M U + ... + M^k U at the last sharpening: nearer to the solution, and how far from it at most (RMS).
  Field nearby_;
  double nearby_error_ = 0;
  Way best_way_ = Way::kComparison;
  int left_before_all_ = 0;  // calls of at() before all ways are tried again
  glm::dvec3 radius_lower_{0.0}, radius_upper_{kNoBound};
};

}  // namespace unshot
