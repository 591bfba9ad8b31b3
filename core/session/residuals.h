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
// spread over places, and a factor of 1.8 either way for what patches are too coarse to carry); they know
// nothing of light that no look has found.
//
// Where the matrix is wrong, in a narrow gap say, so is what it carries: K in its place leaves the residual
// (K - M) e, which the looks know as well, and which is carried in turn.
#pragma once

#include <limits>
#include <vector>

#include "formfactor/receivers.h"
#include "session/residual_places.h"
#include "session/sent_light.h"
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
  ErrorEstimate total;  ///< of the light as it is shown: with what is still unshot
  FormFactorDefects defects;
};

class Residuals {
 public:
  /// All outlive the residuals. `occlusion`: whether anything can stand between two points.
  Residuals(const Mesh& mesh, const Receivers& receivers, bool occlusion, std::uint64_t seed);

  /// As ResidualPlaces::add, ::take, ::restore and ::forget.
  void add(std::size_t places, const MeshField& shown) { places_.add(places, shown); }
  std::vector<ResidualPlace> takePlaces() { return places_.take(); }
  void restorePlaces(std::vector<ResidualPlace> points) { places_.restore(std::move(points)); }
  std::size_t places() const { return places_.points().size(); }
  void forgetPlaces() { places_.forget(); }

  /// Of the present state. `shown`: H as it is shown. `with_total`: where the
  /// matrix lacks little. Costs up to 170 products with the matrix.
  ErrorEstimates estimate(const RadiosityState& state, const PatchMatrix& matrix, const MeshField& shown,
                          bool with_total) const;
  /// RMS over its points of the residual of each patch [W/m^2], channels averaged; a patch with few points
  /// leans on those of its side, a side without points has 0.
  std::vector<double> patchResiduals(const RadiosityState& state, const MeshField& shown) const;

 private:
  struct Residual {
    std::uint32_t patch;
    glm::dvec3 of_look[2];  // r [W/m^2]
    glm::dvec3 reflected;   // rho H as it is shown [W/m^2]
    double weight;
    bool counts;  // in the nRMSE
  };
  std::vector<Residual> pointResiduals(const RadiosityState& state, const MeshField& shown,
                                       bool with_unshot) const;
  std::vector<Residual> receiverResiduals(const RadiosityState& state) const;
  Residual residualOf(const ResidualPlace& place, const glm::dvec3& rho, const SentLight& sent,
                      const glm::dvec3& shown) const;
  bool counts(std::uint32_t patch) const;

  const Mesh& mesh_;
  const Receivers& receivers_;
  ResidualPlaces places_;
  std::vector<char> counts_;  // one a side: whether errors on it count
};

}  // namespace unshot
