// Second table: the program on every scene there is, in a given time.
#pragma once

#include <filesystem>
#include <vector>

namespace unshot::bench {

/// Runs `unshot solve` in a process of its own on each scene (*.obj) under `folders`, and prints what it
/// reached in `seconds` [s]. Errors are given where a folder has reference values (truth/*.csv, whose comment
/// names the scene).
void printSceneTable(const std::vector<std::filesystem::path>& folders, double seconds);

}  // namespace unshot::bench
