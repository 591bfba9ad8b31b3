// Hemicubes drawn with OpenGL against hemicubes traced with rays, on scenes of several sizes.
#pragma once

#include <filesystem>
#include <vector>

namespace unshot::bench {

/// Prints what a hemicube of the default fineness costs either way on each scene (*.obj) under `folders`:
/// median of `patches` patches. Scenes of more than `most` triangles are left out.
void printDrawingTable(const std::vector<std::filesystem::path>& folders, int patches, std::size_t most);

}  // namespace unshot::bench
