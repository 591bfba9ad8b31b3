#include "viewer/script.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/parse.h"
#include "viewer/actions/actions.h"

namespace unshot {
namespace {

constexpr const char* kWaits = "wait converged, wait shots N or wait seconds S";

/// "converged", "shots 10", "seconds 1.5".
void parseWait(const std::string& argument, ScriptLine& line, const std::string& where) {
  std::istringstream words(argument);
  std::string what, amount, extra;
  words >> what >> amount >> extra;
  const auto refuse = [&](const std::string& message) {
    throw Error(ErrorKind::kUsage, message, where, kWaits);
  };
  if (!extra.empty()) refuse("'wait " + argument + "' says too much");
  if (what == "converged") {
    if (!amount.empty()) refuse("'wait converged' takes no number");
    line.wait = WaitFor::kConverged;
    return;
  }
  if (what != "shots" && what != "seconds") refuse("'wait' does not say what for");
  const std::optional<double> number = parseNumber(amount);
  if (!number || !(*number >= 0) || !std::isfinite(*number)) refuse("'wait " + what + "' needs a number");
  line.wait = what == "shots" ? WaitFor::kShots : WaitFor::kSeconds;
  line.amount = *number;
}

}  // namespace

std::vector<ScriptLine> parseScript(std::istream& text, const std::string& name) {
  std::vector<ScriptLine> script;
  std::string raw;
  for (int number = 1; std::getline(text, raw); ++number) {
    const std::string content(trimmed(raw));
    if (content.empty() || content.front() == '#') continue;
    ScriptLine line;
    line.number = number;
    const std::size_t space = content.find_first_of(" \t");
    line.action = content.substr(0, space);
    if (space != std::string::npos) line.argument = trimmed(std::string_view(content).substr(space));
    const std::string where = name + ":" + std::to_string(number);
    if (line.action == "wait") {
      parseWait(line.argument, line, where);
    } else {
      try {
        const std::string wrong = checkArgument(findAction(line.action), line.argument);
        if (!wrong.empty()) throw Error(ErrorKind::kUsage, wrong, {}, "unshot list shows every action");
      } catch (const Error& error) {
        throw Error(error.kind(), error.what(), where, error.advice());
      }
    }
    script.push_back(std::move(line));
  }
  return script;
}

std::vector<ScriptLine> readScript(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::error_code error;
  if (!stream || std::filesystem::is_directory(file, error)) {
    throw Error(ErrorKind::kInput, "the script cannot be read", file.string(), "the path of a text file");
  }
  return parseScript(stream, file.string());
}

}  // namespace unshot
