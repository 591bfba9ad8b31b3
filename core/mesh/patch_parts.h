// Patches that span several surfaces: triangles of a curved surface that are smaller than a patch has to be
// shoot together. Their elements keep light of their own.
#pragma once

#include "base/cancel.h"
#include "mesh/mesh.h"

namespace unshot {

/// Joins patches of surfaces that meet smoothly (Mesh::smooth_pairs) and are one patch each, as far as the
/// joined patch is not larger than Mesh::patch_size squared, all of it faces about one way and the same air,
/// and none of it emits. For a mesh whose patches are one part each, with patch_air.
void joinSmallPatches(Mesh& mesh, const CancelToken& cancel = {});

/// Joins the same patches as those of `base`, of which the mesh has the surfaces, sides and local patches.
void joinPatchesAs(const Mesh& base, Mesh& mesh);

}  // namespace unshot
