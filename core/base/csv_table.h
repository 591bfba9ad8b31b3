// Comma-separated values: # comments, blank lines and a header line are allowed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unshot {

/// The cells of a file, as text without blanks at their ends. Every row has as many cells as the first line
/// has.
struct CsvTable {
  std::filesystem::path path;
  std::vector<std::string> header;  ///< empty where the first line starts with a number
  std::vector<std::vector<std::string>> rows;
  std::vector<std::size_t> lines;  ///< line of each row in the file, counted from 1

  /// Index of the column of that name.
  std::optional<std::size_t> column(std::string_view name) const;
  /// The number in a cell; nothing for an empty cell. Throws Error (kInput, file:line) for other text.
  std::optional<double> number(std::size_t row, std::size_t column) const;
  /// "file:line" of a row.
  std::string where(std::size_t row) const;
};

/// Throws Error (kInput; with file:line where rows differ in length, or the file is not text).
CsvTable readCsv(const std::filesystem::path& path);

/// A number with the fewest digits that read back as the same value.
std::string shortest(double value);
std::string shortest(float value);

}  // namespace unshot
