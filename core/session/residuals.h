// Errors of form factors and of the mesh, estimated at random places by looks through the true geometry.
//
// Form factors: at random receivers, what a far denser row gathers from the patches as the solver has them,
// S, against the H that it has. Both together with the mesh: at random points off the mesh, the residual of
// the continuous equation, B(x) = E + rho H[B](x), displayed light against what is gathered of it; what is
// unshot is left out on both sides, for that is the solver's error. Each place is looked at twice, and
// squares are products of the two, so that the noise of a look does not count as error.
//
// A residual r is carried through the kept matrix: the error is e = r + c with c = (I - M)^-1 M r, where r of
// a patch is known from the points that fall on it. Estimates with confidence intervals (95 %, from the
// spread over places); they know nothing of light that no look has found.
#pragma once

#include <limits>
#include <vector>

#include "formfactor/receivers.h"
#include "session/gather.h"
#include "solver/patch_matrix.h"
#include "solver/state.h"

namespace unshot {

/// nRMSE of reflected light at points without emission of their own, with its interval.
struct ErrorEstimate {
  double value = 0, low = 0, high = std::numeric_limits<double>::infinity();
  std::size_t places = 0;  ///< 0: no estimate yet
};

struct ErrorEstimates {
  ErrorEstimate form_factor;
  ErrorEstimate discretisation;  ///< what the mesh adds to the form factors: both^2 - form_factor^2
  ErrorEstimate both;
  FormFactorDefects defects;
};

class Residuals {
 public:
  /// All outlive the residuals.
  Residuals(const Mesh& mesh, const Receivers& receivers, std::uint64_t seed);

  /// Takes `places` more points and as many receivers; a place costs some 700 rays.
  void add(std::size_t places);
  std::size_t places() const { return points_.size(); }

  /// Of the present state. `shown`: H as it is shown, one per receiver [W/m^2]. Costs some ten products with
  /// the matrix.
  ErrorEstimates estimate(const RadiosityState& state, const PatchMatrix& matrix,
                          const std::vector<glm::dvec3>& shown) const;
  /// RMS over its points of the residual of each patch [W/m^2], channels averaged; a patch with few points
  /// leans on those of its side, a side without points has 0.
  std::vector<double> patchResiduals(const RadiosityState& state, const std::vector<glm::dvec3>& shown) const;

 private:
  struct Place {
    std::uint32_t patch = 0;
    std::uint32_t triangle = 0;  // display triangle, of points
    glm::dvec3 weights{0.0};     // barycentric in it
    std::uint32_t receiver = 0;  // of receivers
    Gather looks[2];
  };
  struct Residual {
    std::uint32_t patch;
    glm::dvec3 of_look[2];  // r [W/m^2]
    glm::dvec3 reflected;   // rho H as it is shown [W/m^2]
  };
  void addPoint(std::uint64_t number);
  void addReceiver(std::uint64_t number);
  std::vector<Residual> pointResiduals(const RadiosityState& state,
                                       const std::vector<glm::dvec3>& shown) const;
  std::vector<Residual> receiverResiduals(const RadiosityState& state) const;
  glm::dvec3 skyOf(const RadiosityState& state) const;
  bool counts(std::uint32_t patch) const;
  double areaOf(std::uint32_t receiver) const;

  const Mesh& mesh_;
  const Receivers& receivers_;
  std::uint64_t seed_;
  Gatherer gatherer_;
  std::vector<double> triangle_area_sum_, receiver_area_sum_;
  std::vector<std::vector<std::uint32_t>> triangles_of_element_;
  bool all_emit_ = true;
  std::vector<Place> points_, elements_;
};

}  // namespace unshot
