// The sub-commands: each adds its options to a parser and leaves in `run` what is to be done.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace unshot {

/// What a parsed sub-command does; returns the exit code.
using Run = std::function<int()>;

void addViewCommand(CLI::App& app, Run& run);
void addSolveCommand(CLI::App& app, Run& run);
void addCheckCommand(CLI::App& app, Run& run);
void addCompareCommand(CLI::App& app, Run& run);
void addListCommand(CLI::App& app, Run& run);

}  // namespace unshot
