// Corrections applied so that what is unshot becomes as small as any combination with those before allows:
// generalised conjugate residuals (Eisenstat, Elman and Schultz 1983), per channel.
#pragma once

#include <deque>
#include <vector>

#include "solver/light_flow.h"
#include "solver/state.h"

namespace unshot {

class MinimalResidual {
 public:
  /// Against so many directions at most.
  explicit MinimalResidual(std::size_t most = 40) : most_(most) {}
  /// The direction `flow` is made orthogonal, in (I - M) d, to those before, and applied times the factor
  /// that leaves the least. Lengths are measured with the weight A / rho, in which (I - M) of a reciprocal K
  /// is symmetric and positive, so that d = U never stands still. The oldest directions go when there is no
  /// room. Throws IterationFailure, with the state as before, where the system has no solution.
  void apply(RadiosityState& state, const Transport& transport, LightFlow flow);
  std::size_t bytes() const;  ///< memory of the directions

 private:
  struct Direction {
    LightFlow flow;
    std::vector<glm::dvec3> image;  // (I - M) d
    glm::dvec3 square;              // of the image
    std::size_t bytes() const {
      return (flow.irradiance.size() + flow.shot.size() + image.size()) * sizeof(glm::dvec3);
    }
  };
  std::size_t most_;
  std::vector<glm::dvec3> weight_;
  std::deque<Direction> directions_;
};

}  // namespace unshot
