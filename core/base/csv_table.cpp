#include "base/csv_table.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "base/parse.h"
#include "base/read_file.h"

namespace unshot {
namespace {

[[noreturn]] void failAt(const std::string& where, const std::string& message, const std::string& advice) {
  throw Error(ErrorKind::kInput, message, where, advice);
}

std::string placeOf(const std::filesystem::path& path, std::size_t line) {
  return path.string() + ":" + std::to_string(line);
}

template <class Value>
std::string shortestDigits(Value value) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, error == std::errc{} ? end : buffer);
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

std::optional<double> CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string& cell = rows[row][column];
  if (cell.empty()) return std::nullopt;
  const std::optional<double> value = parseNumber(cell);
  if (!value)
    failAt(where(row), "'" + cell + "' is not a number",
           "a decimal number in column " + std::to_string(column + 1));
  return value;
}

std::string CsvTable::where(std::size_t row) const { return placeOf(path, lines[row]); }

CsvTable readCsv(const std::filesystem::path& path) {
  const std::string bytes = readFile(path);
  if (bytes.find('\0') != std::string::npos)
    failAt(path.string(), "this is not a text file", "comma-separated values");
  CsvTable table;
  table.path = path;
  std::size_t columns = 0;
  std::size_t line_number = 0;
  std::string_view rest = bytes;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // byte order mark
  while (!rest.empty()) {
    ++line_number;
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string_view> cells = splitParts(line, ',');
    if (columns == 0) {
      columns = cells.size();
      if (!parseNumber(cells.front())) {
        table.header.assign(cells.begin(), cells.end());
        continue;
      }
    }
    if (cells.size() != columns) {
      failAt(placeOf(path, line_number),
             "there are " + std::to_string(cells.size()) + " values where " + std::to_string(columns) +
                 " were expected",
             "the same number of values in every line");
    }
    table.rows.emplace_back(cells.begin(), cells.end());
    table.lines.push_back(line_number);
  }
  return table;
}

std::string shortest(double value) { return shortestDigits(value); }

std::string shortest(float value) { return shortestDigits(value); }

}  // namespace unshot
