// A mesh as coarse as the error asked for allows, where nothing can occlude: coarse ones are tried first,
// each solved at once and its error estimated without noise, at a hundredth of what the usual mesh takes.
#pragma once

#include <functional>
#include <memory>

#include "base/cancel.h"
#include "mesh/mesh.h"
#include "session/residuals.h"

namespace unshot {

struct CoarseTrial {
  double error = 0.01;  ///< of the whole light, asked for
  double usual = 0;     ///< elements of the usual mesh
  std::uint64_t seed = 1;
  /// The mesh of about so many elements, which follows the light.
  std::function<std::shared_ptr<const Mesh>(double)> make;
};

struct CoarseMesh {
  std::shared_ptr<const Mesh> mesh;
  ErrorEstimate error;  ///< of form factors and mesh together
};

/// Whether trials can tell anything: `coarsest` is the scene's mesh with as few elements as can be. Emitters
/// must be wider than the elements tried, for light changes fast in front of small ones, where no trial may
/// look.
bool mayBeCoarse(const Mesh& coarsest, double usual);

/// The coarsest mesh tried whose error is surely within what is asked for; without a mesh where none is,
/// which is given up early. For scenes without a sky in which nothing can stand between two points
/// (nothingCanOcclude). Throws Cancelled.
CoarseMesh findCoarseMesh(const CoarseTrial& trial, const CancelToken& cancel);

/// The error of such a mesh, solved at once: the time grows with the square of its elements.
ErrorEstimate tryMesh(const Mesh& mesh, std::uint64_t seed, const CancelToken& cancel);

}  // namespace unshot
