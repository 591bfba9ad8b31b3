#include "scene/mtl_scan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "scene/obj_text.h"

namespace unshot {
namespace {

/// Statements that ask for more than a diffuse surface, and the value at which they ask for nothing.
struct ReadPast {
  std::string_view keyword;
  std::optional<double> neutral;  ///< none: any value counts
};

constexpr std::array<ReadPast, 22> kReadPast{{
    {"Ks", 0.0},      {"d", 1.0},     {"Tr", 0.0},    {"Tf", 1.0},      {"Pr", 0.0},      {"Pm", 0.0},
    {"Ps", 0.0},      {"Pc", 0.0},    {"map_Ks", {}}, {"map_d", {}},    {"map_Ke", {}},   {"map_Bump", {}},
    {"map_bump", {}}, {"bump", {}},   {"disp", {}},   {"map_disp", {}}, {"map_Disp", {}}, {"norm", {}},
    {"refl", {}},     {"map_Pr", {}}, {"map_Pm", {}}, {"decal", {}},
}};

bool isNeutral(std::string_view rest, double neutral) {
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
    double value = 0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc() || value != neutral) return false;
  }
  return true;
}

class Scanner {
 public:
  MtlScan run(std::string_view text) {
    LineReader reader(text);
    LogicalLine line;
    while (reader.next(line)) {
      line_ = line.line;
      statement(line.text);
    }
    return std::move(scan_);
  }

 private:
  void statement(std::string_view text) {
    std::string_view rest = text;
    const std::string_view keyword = takeWord(rest);
    if (keyword == "newmtl") {
      // The name is the entry's own; tinyobjloader gets one that it cannot misread.
      scan_.entries.push_back({});
      scan_.entries.back().name = std::string(withoutBlanks(rest));
      scan_.entries.back().line = line_;
      scan_.plain += "newmtl m" + std::to_string(scan_.entries.size()) + "\n";
      return;
    }
    if (scan_.entries.empty()) return;
    MtlEntry& entry = scan_.entries.back();
    if (keyword == "Kd") {
      entry.diffuse_text = std::string(withoutComment(withoutBlanks(rest)));
      entry.diffuse_line = line_;
      entry.diffuse_readable = colour("Kd", rest);
    } else if (keyword == "Ke") {
      entry.emission_text = std::string(withoutComment(withoutBlanks(rest)));
      entry.emission_line = line_;
      entry.emission_readable = colour("Ke", rest);
    } else if (keyword == "map_Kd") {
      entry.texture_line = line_;
      scan_.plain.append("map_Kd ").append(withoutBlanks(rest)).append("\n");
    } else {
      readPast(entry, keyword, rest);
    }
  }

  /// One number stands for all three (the format's rule); tinyobjloader would take 0 for the others.
  bool colour(std::string_view keyword, std::string_view rest) {
    rest = rest.substr(0, rest.find('#'));
    std::array<std::string, 3> words;
    std::size_t count = 0;
    while (count < 3) {
      const std::string_view word = takeWord(rest);
      if (word.empty()) break;
      const NumberKind kind = numberKind(word);
      if (kind == NumberKind::kNoNumber) return false;
      const bool low = kind == NumberKind::kNan || kind == NumberKind::kNegativeInfinite;
      words[count++] = kind == NumberKind::kFinite ? std::string(word) : low ? "-1e999" : "1e999";
    }
    if (count == 0) return false;
    for (std::size_t i = count; i < 3; ++i) words[i] = words[count - 1];
    scan_.plain.append(keyword);
    for (const std::string& word : words) scan_.plain += " " + word;
    scan_.plain += "\n";
    return true;
  }

  static void readPast(MtlEntry& entry, std::string_view keyword, std::string_view rest) {
    const auto known = std::find_if(kReadPast.begin(), kReadPast.end(),
                                    [&](const ReadPast& row) { return row.keyword == keyword; });
    if (known == kReadPast.end()) return;
    if (known->neutral && isNeutral(rest.substr(0, rest.find('#')), *known->neutral)) return;
    if (std::find(entry.read_past.begin(), entry.read_past.end(), keyword) != entry.read_past.end()) return;
    entry.read_past.emplace_back(keyword);
  }

  MtlScan scan_;
  std::uint32_t line_ = 0;
};

}  // namespace

MtlScan scanMtl(std::string_view text) { return Scanner().run(text); }

std::filesystem::path findBeside(const std::filesystem::path& folder, std::string_view name) {
  const auto attempt = [&](std::string_view spelling) -> std::filesystem::path {
    spelling = withoutBlanks(spelling);
    if (spelling.size() >= 2 && spelling.front() == '"' && spelling.back() == '"') {
      spelling = spelling.substr(1, spelling.size() - 2);
    }
    if (spelling.empty()) return {};
    std::string slashes(spelling);
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    std::error_code failure;
    for (const std::string& candidate : {std::string(spelling), slashes}) {
      const std::filesystem::path path = folder / candidate;
      if (std::filesystem::is_regular_file(path, failure)) return path;
    }
    return {};
  };
  const std::filesystem::path path = attempt(name);
  return path.empty() ? attempt(withoutComment(name)) : path;
}

}  // namespace unshot
