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
#include <optional>
#include <vector>

#include "formfactor/receivers.h"
#include "mesh/element_points.h"
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
  ErrorEstimate total;  ///< of the light as it is shown: with what is still unshot
  FormFactorDefects defects;
};

class Residuals {
 public:
  /// All outlive the residuals.
  Residuals(const Mesh& mesh, const Receivers& receivers, std::uint64_t seed);

  /// Takes `places` more points and as many receivers; a place costs some 700 rays. Half of them are spread
  /// evenly over the area, half by the square of the light that is reflected there, of which `shown` is H as
  /// it is shown (one per receiver [W/m^2]): a few bright places can hold most of an error. Surfaces that
  /// emit have places too, for what goes on from there.
  void add(std::size_t places, const std::vector<glm::dvec3>& shown);
  std::size_t places() const { return points_.size(); }
  /// Those that follow are chosen by the light as it is then.
  void forgetPlaces();

  /// Of the present state. `shown`: H as it is shown, one per receiver [W/m^2]. `with_total`: where the
  /// matrix lacks little. Costs up to 170 products with the matrix.
  ErrorEstimates estimate(const RadiosityState& state, const PatchMatrix& matrix,
                          const std::vector<glm::dvec3>& shown, bool with_total) const;
  /// RMS over its points of the residual of each patch [W/m^2], channels averaged; a patch with few points
  /// leans on those of its side, a side without points has 0.
  std::vector<double> patchResiduals(const RadiosityState& state, const std::vector<glm::dvec3>& shown) const;

 private:
  struct Place {
    std::uint32_t patch = 0;
    std::uint32_t triangle = 0;  // display triangle, of points
    glm::dvec3 weights{0.0};     // barycentric in it
    std::uint32_t receiver = 0;  // of receivers
    double weight = 1;           // density of even places over that of these
    Gather looks[2];
  };
  struct Residual {
    std::uint32_t patch;
    glm::dvec3 of_look[2];  // r [W/m^2]
    glm::dvec3 reflected;   // rho H as it is shown [W/m^2]
    double weight;
    bool counts;  // in the nRMSE
  };
  struct Sent {
    std::vector<glm::dvec3> emission;  // one per patch [W/m^2]
    std::vector<glm::dvec3> light;     // besides emission, one per element [W/m^2]
    glm::dvec3 sky{0.0};               // [W/m^2]
  };
  struct Choice {
    std::uint32_t index;
    double weight;
  };
  static Choice choose(const std::vector<double>& area_sum, const std::vector<double>& light_sum,
                       std::uint64_t number, std::uint64_t seed);
  void findLight(const std::vector<glm::dvec3>& shown);
  void addPoint(std::uint64_t number);
  void addReceiver(std::uint64_t number);
  std::vector<Residual> pointResiduals(const RadiosityState& state, const std::vector<glm::dvec3>& shown,
                                       bool with_unshot) const;
  std::vector<Residual> receiverResiduals(const RadiosityState& state) const;
  Residual residualOf(const Place& place, const glm::dvec3& rho, const Sent& sent,
                      const glm::dvec3& shown) const;
  static glm::dvec3 irradianceOf(const Gather& gather, const Sent& sent);
  void setSources(const RadiosityState& state, bool with_unshot, Sent& sent) const;
  bool counts(std::uint32_t patch) const;
  double areaOf(std::uint32_t receiver) const;

  const Mesh& mesh_;
  const Receivers& receivers_;
  std::uint64_t seed_;
  Gatherer gatherer_;
  // Running sums over triangles and receivers: of the area where places may lie, and of the square of the
  // light there.
  std::vector<double> triangle_area_sum_, receiver_area_sum_;
  std::vector<double> triangle_light_sum_, receiver_light_sum_;
  std::optional<ElementPoints> element_points_;  // where receivers are elements
  std::vector<char> counts_;                     // one a side: whether errors on it count
  std::vector<Place> points_, elements_;
};

}  // namespace unshot
