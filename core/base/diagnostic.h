// Doubts about a scene or a solve: never exceptions, always shown and reported.
#pragma once

#include <string>
#include <vector>

namespace unshot {

enum class Severity { kNote, kWarning };

/// One doubt: a short stable code ("duplicate-face"), what was found (with its count), where (file:line),
/// what was done about it or what to try.
struct Diagnostic {
  Severity severity = Severity::kWarning;
  std::string code;
  std::string message;
  std::string where;
  std::string advice;
};

using Diagnostics = std::vector<Diagnostic>;

}  // namespace unshot
