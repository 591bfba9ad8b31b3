// Closed-form factors: K_vq is the exact Lambert factor of receiver point v and patch q, without occlusion.
//
// In a convex enclosure rows then sum to 1 to rounding wherever the receiver stands. Assumes that nothing
// lies between (methods.h says how that is decided); known error: none in K but rounding, so what is left of
// a solution's error comes from the patches' constant radiosity and the trapezoidal mean over a patch's
// vertices.
#include "formfactor/methods.h"
#include "formfactor/pointwise.h"

namespace unshot {

std::unique_ptr<FormFactorMethod> makeClosedForm(const FormFactorSetup& setup) {
  return std::make_unique<Pointwise>(setup, std::make_shared<const PatchPolygons>(*setup.mesh, setup.cancel),
                                     nullptr);
}

}  // namespace unshot
