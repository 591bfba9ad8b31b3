// What shadow rays through the true geometry find visible (rays.cpp).
#pragma once

#include "formfactor/pointwise.h"

namespace unshot {

/// The mesh must outlive it.
std::unique_ptr<Visibility> makeShadowRays(const Mesh& mesh, std::shared_ptr<const PatchPolygons> polygons,
                                           std::uint64_t seed);

}  // namespace unshot
