// What the plan leaves out on each scene, and what that saves.
#pragma once

#include <filesystem>
#include <vector>

namespace unshot::bench {

/// Solves each scene as `unshot solve` does, then with each of its decisions done all the same, and with all
/// of them, for `seconds` at most, and prints CPU and memory of both.
void printPlanTable(const std::vector<std::filesystem::path>& scenes, double seconds);

}  // namespace unshot::bench
