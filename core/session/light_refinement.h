// A mesh that follows the light: finer where light straight from emitters is not what interpolation makes of
// it, at the edges of shadows first of all.
#pragma once

#include <memory>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

struct LightRefinement {
  double error = 0.01;                      ///< of the whole light, aimed at; direct light gets a part of it
  std::uint64_t most_elements = 1'000'000;  ///< about
  bool occlusion = true;                    ///< whether anything can stand between two points
  std::uint64_t seed = 1;
  /// Where given: the same surfaces in elements as large as can be, which stand for emitters where nothing
  /// occludes, and there are fewer to look at.
  std::shared_ptr<const Mesh> emitters;
};

/// Of a uniform mesh, first where gaps in front of lamps are narrow (session/gap_refinement.h): that is the
/// base of the result, or the result itself where nothing asks for more. Throws Cancelled.
std::shared_ptr<const Mesh> refineForLight(std::shared_ptr<const Mesh> uniform,
                                           const LightRefinement& options, const CancelToken& cancel = {});

}  // namespace unshot
