// A mesh in a file, with the one that it refines.
#pragma once

#include <memory>

#include "base/archive.h"
#include "mesh/mesh.h"

namespace unshot {

void writeMesh(ArchiveWriter& archive, const Mesh& mesh);
/// Throws Error as the archive does.
std::shared_ptr<const Mesh> readMesh(ArchiveReader& archive);

}  // namespace unshot
