// A mesh as coarse as the error asked for allows, where nothing can occlude: coarse ones are tried first,
// each solved at once and its error estimated without noise, at a hundredth of what the usual mesh takes.
#pragma once

#include <functional>
#include <memory>

#include "base/cancel.h"
#include "formfactor/method.h"
#include "mesh/mesh.h"
#include "session/residuals.h"
#include "solver/state.h"

namespace unshot {

struct CoarseTrial {
  double error = 0.01;  ///< of the whole light, asked for
  double usual = 0;     ///< elements of the usual mesh
  std::uint64_t seed = 1;
  bool fewer_channels = true;  ///< those that are alike are solved once (RadiosityState::allowFewerChannels)
  /// The mesh of about so many elements, which follows the light.
  std::function<std::shared_ptr<const Mesh>(double)> make;
};

/// The light of a mesh, solved at once: what a solve on it can begin, and end, with.
struct SolvedAtOnce {
  std::vector<Column> columns;  ///< one per patch
  RadiosityState::Values values;
  std::vector<glm::dvec3> local_irradiance;  ///< LocalPass::irradiance; empty where the mesh has no base
  ErrorEstimate error;                       ///< of form factors and mesh together
  std::vector<ResidualPlace> places;         ///< that it was estimated at (ResidualPlaces::take)
};

struct CoarseMesh {
  std::shared_ptr<const Mesh> mesh;
  SolvedAtOnce solved;
};

/// Whether trials can tell anything: `coarsest` is the scene's mesh with as few elements as can be. Emitters
/// must be wider than the elements tried, for light changes fast in front of small ones, where no trial may
/// look.
bool mayBeCoarse(const Mesh& coarsest, double usual);

/// The coarsest mesh tried whose error is surely within what is asked for; without a mesh where none is,
/// which is given up early. For scenes without a sky in which nothing can stand between two points
/// (nothingCanOcclude). `coarsest`: see mayBeCoarse. Throws Cancelled.
CoarseMesh findCoarseMesh(const Mesh& coarsest, const CoarseTrial& trial, const CancelToken& cancel);

/// `enough`: more places are looked at where they may show that the error's upper end is below. The time
/// grows with the square of the mesh's elements.
SolvedAtOnce solveAtOnce(const Mesh& mesh, double enough, std::uint64_t seed, bool fewer_channels,
                         const CancelToken& cancel);

}  // namespace unshot
