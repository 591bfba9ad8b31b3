// How figures and doubts look on a terminal.
#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/text.h"

namespace unshot {

/// Lines of a label and a value, with the values aligned. A label that repeats the line before is left out.
using Lines = std::vector<std::pair<std::string, std::string>>;
void printLines(std::ostream& out, const Lines& lines);

/// One line a doubt: "file:line: warning: message", then "  try: advice" where there is some.
void printDiagnostics(std::ostream& out, const Diagnostics& diagnostics);

}  // namespace unshot
