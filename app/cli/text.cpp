#include "cli/text.h"

#include <algorithm>
#include <ostream>

namespace unshot {

void printLines(std::ostream& out, const Lines& lines) {
  std::size_t width = 0;
  for (const auto& line : lines) width = std::max(width, line.first.size());
  std::string last;
  for (const auto& [label, value] : lines) {
    const std::string shown = label == last ? "" : label;
    out << shown << std::string(width - shown.size() + 2, ' ') << value << "\n";
    last = label;
  }
}

void printDiagnostics(std::ostream& out, const Diagnostics& diagnostics) {
  for (const Diagnostic& d : diagnostics) {
    if (!d.where.empty()) out << d.where << ": ";
    out << (d.severity == Severity::kWarning ? "warning: " : "note: ") << d.message << "\n";
    if (!d.advice.empty()) out << "  try: " << d.advice << "\n";
  }
  out.flush();
}

}  // namespace unshot
