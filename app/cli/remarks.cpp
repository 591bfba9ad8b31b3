#include "cli/remarks.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <ostream>
#include <sstream>
#include <tuple>

namespace unshot {
namespace {

constexpr std::size_t kNoTerminal = 100, kNarrowest = 40;

std::string severityText(Severity severity) { return severity == Severity::kWarning ? "warning" : "note"; }

/// "file:12" as file and 12; line 0 where there is none.
std::pair<std::string, unsigned long> placeParts(const std::string& where) {
  const std::size_t colon = where.rfind(':');
  const bool line = colon != std::string::npos && colon + 1 < where.size() &&
                    where.find_first_not_of("0123456789", colon + 1) == std::string::npos &&
                    where.size() - colon < 12;
  if (!line) return {where, 0};
  return {where.substr(0, colon), std::stoul(where.substr(colon + 1))};
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

}  // namespace

void sortRemarks(Diagnostics& remarks) {
  std::stable_sort(remarks.begin(), remarks.end(), [](const Diagnostic& a, const Diagnostic& b) {
    const auto key = [](const Diagnostic& d) {
      const auto [file, line] = placeParts(d.where);
      return std::tuple(d.severity == Severity::kWarning ? 0 : 1, d.where.empty(), file, line);
    };
    return key(a) < key(b);
  });
}

void printRemarks(std::ostream& out, const Diagnostics& remarks, std::size_t width) {
  std::size_t severity_width = 0, code_width = 0;
  for (const Diagnostic& d : remarks) {
    severity_width = std::max(severity_width, severityText(d.severity).size());
    code_width = std::max(code_width, d.code.size());
  }
  const std::string indent(severity_width + 2, ' ');
  for (const Diagnostic& d : remarks) {
    out << "\n" << padded(severityText(d.severity), severity_width) << "  ";
    out << (d.where.empty() ? d.code : padded(d.code, code_width) + "  " + d.where) << "\n";
    out << wrapped(indent, d.message, width);
    if (!d.advice.empty()) out << wrapped(indent + "try: ", d.advice, width);
  }
}

std::string wrapped(const std::string& first, const std::string& text, std::size_t width) {
  std::string out, line = first;
  bool empty = true;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!empty && line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line = std::string(first.size(), ' ');
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return out + line + "\n";
}

std::size_t outputWidth() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kNoTerminal;
  return std::max<std::size_t>(size.ws_col, kNarrowest);
}

}  // namespace unshot
