// The sky as one more source, behind all patches: of one radiosity from wherever no surface hides it.
//
// K of a receiver and the sky is the share of the receiver's view that no surface fills. It is looked for by
// rays through the true geometry, distributed by the cosine, one in each stratum of a grid; a stratum whose
// neighbours disagree with it is looked at by sixteen.
//
// Known error: random, 0.1 to 0.5 % of an open view; what is smaller than a stratum may be missed.
#pragma once

#include <cstdint>
#include <memory>

#include "base/cancel.h"
#include "formfactor/method.h"

namespace unshot {

struct SkySource {
  Column column;
  /// sum_v A_v K_v,sky [m^2]: the sky counts as a source of this area, so that all of its light arrives. 0
  /// where no surface sees it.
  double area = 0;
};

/// What each receiver sees of the sky; the same for the same seed. Of two layers of receivers those of the
/// base receive it, as other light that is smooth. Throws Cancelled where `cancel` asks for it.
SkySource lookAtSky(const Mesh& mesh, const Receivers& receivers, std::uint64_t seed,
                    const CancelToken& cancel = {});

/// The method with the sky's column behind those of its `patches`.
std::unique_ptr<FormFactorMethod> withSky(std::unique_ptr<FormFactorMethod> method, std::uint32_t patches,
                                          Column sky);

}  // namespace unshot
