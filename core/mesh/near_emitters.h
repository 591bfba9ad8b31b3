// Finer cells beside small emitters, where light falls off within less than a cell of the usual size.
#pragma once

#include <vector>

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// `sizes`: of the cells of each of the mesh's surfaces [m]. Those that reflect and lie near an emitter that
/// is about as small as they are, or smaller, become a share of their distance to it, within a number of
/// cells a surface. `mesh` needs surfaces and sides. Throws Cancelled where `cancel` asks for it.
void refineNearEmitters(const Mesh& mesh, std::vector<double>& sizes, const CancelToken& cancel);

}  // namespace unshot
