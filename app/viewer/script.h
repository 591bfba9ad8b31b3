// Scripts of the viewer: one action a line, `wait ...` between them, # comments.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace unshot {

enum class WaitFor { kNothing, kConverged, kShots, kSeconds };

struct ScriptLine {
  int number = 0;  ///< in the file, counted from 1
  std::string action, argument;
  WaitFor wait = WaitFor::kNothing;  ///< where it is a wait: no action
  double amount = 0;                 ///< shots or seconds
};

/// Reads and checks a whole script before anything of it runs: actions are those of actions.h. `name` stands
/// in messages. Throws Error: kUsage with file and line.
std::vector<ScriptLine> parseScript(std::istream& text, const std::string& name);
/// Throws Error kInput where the file cannot be read too.
std::vector<ScriptLine> readScript(const std::filesystem::path& file);

}  // namespace unshot
