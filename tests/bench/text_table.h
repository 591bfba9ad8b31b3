// A table of text, its columns aligned: names to the left, figures to the right.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace unshot::bench {

class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) { rows_.push_back(std::move(header)); }
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

  void print() const {
    std::vector<std::size_t> width(rows_[0].size(), 0);
    for (const auto& row : rows_) {
      for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
    }
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      std::string line;
      for (std::size_t k = 0; k < rows_[r].size(); ++k) {
        const std::string pad(width[k] - rows_[r][k].size(), ' ');
        line += (k == 0 ? rows_[r][k] + pad : "  " + pad + rows_[r][k]);
      }
      std::printf("%s\n", line.c_str());
      if (r > 0) continue;
      std::string rule;
      for (std::size_t k = 0; k < width.size(); ++k)
        rule += (k == 0 ? "" : "  ") + std::string(width[k], '-');
      std::printf("%s\n", rule.c_str());
    }
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// A number with the given printf format.
inline std::string figure(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace unshot::bench
