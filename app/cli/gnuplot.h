// Plots, drawn by gnuplot where it is installed.
#pragma once

#include <filesystem>
#include <string>

namespace unshot {

/// Whether a program of that name can be started.
bool hasGnuplot();

/// Runs the script `name` in `folder`, which it has as its working folder. Returns what went wrong, or
/// nothing. Ctrl-C does not reach it.
std::string runGnuplot(const std::filesystem::path& folder, const std::string& name);

}  // namespace unshot
