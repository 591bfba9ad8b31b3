// The command line: finds the sub-command and runs it.
#pragma once

#include <string_view>

namespace unshot {

/// Runs what the arguments ask for and returns the exit code. Throws Error (kUsage for what cannot be
/// parsed).
int runCommandLine(int argc, const char* const* argv);

/// Whether `word` is the name of a sub-command.
bool isCommand(std::string_view word);

}  // namespace unshot
