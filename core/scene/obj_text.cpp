#include "scene/obj_text.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>

#include "base/error.h"

namespace unshot {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 22;  // of a file, read at once [bytes]
constexpr std::string_view kBlanks = " \t\v\f";

bool isBlank(char c) { return kBlanks.find(c) != std::string_view::npos; }

bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::size_t skipDigits(std::string_view word, std::size_t i) {
  while (i < word.size() && isDigit(word[i])) ++i;
  return i;
}

bool equalsIgnoringCase(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(),
                    [](char x, char y) { return std::tolower(static_cast<unsigned char>(x)) == y; });
}

/// Whether a logical line goes on after this piece. A comment ends with its line, or a path such as "C:\" in
/// one would swallow the next statement.
bool continues(std::string_view piece) {
  return !piece.empty() && piece.back() == '\\' && withoutComment(piece).size() == piece.size();
}

}  // namespace

std::string_view withoutBlanks(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view withoutComment(std::string_view text) {
  for (std::size_t i = text.find('#'); i != std::string_view::npos; i = text.find('#', i + 1)) {
    if (i == 0 || isBlank(text[i - 1])) return withoutBlanks(text.substr(0, i));
  }
  return text;
}

std::string_view takeWord(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && isBlank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !isBlank(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

LineReader::LineReader(std::string_view text) : rest_(text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::string_view LineReader::physicalLine() {
  std::size_t end = 0;
  while (end < rest_.size() && rest_[end] != '\n' && rest_[end] != '\r') ++end;
  const std::string_view line = rest_.substr(0, end);
  if (end < rest_.size()) {
    const bool pair = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
    end += pair ? 2 : 1;
  }
  rest_.remove_prefix(end);
  ++line_;
  return withoutBlanks(line);
}

bool LineReader::next(LogicalLine& line) {
  while (!rest_.empty()) {
    std::string_view piece = physicalLine();
    line.line = line_;
    if (continues(piece)) {
      joined_.clear();
      while (continues(piece)) {
        joined_.append(piece.substr(0, piece.size() - 1)).append(" ");
        piece = rest_.empty() ? std::string_view() : physicalLine();
      }
      joined_.append(piece);
      piece = withoutBlanks(joined_);
    }
    if (piece.empty() || piece.front() == '#') continue;
    line.text = piece;
    return true;
  }
  return false;
}

NumberKind numberKind(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  std::size_t i = skipDigits(word, 0);
  std::size_t digits = i;
  if (i < word.size() && word[i] == '.') {
    const std::size_t begin = ++i;
    i = skipDigits(word, i);
    digits += i - begin;
  }
  if (digits == 0) {
    if (equalsIgnoringCase(word, "inf") || equalsIgnoringCase(word, "infinity")) {
      return negative ? NumberKind::kNegativeInfinite : NumberKind::kInfinite;
    }
    const bool nan = word.size() >= 3 && equalsIgnoringCase(word.substr(0, 3), "nan");
    return nan ? NumberKind::kNan : NumberKind::kNoNumber;
  }
  if (i < word.size() && (word[i] == 'e' || word[i] == 'E')) {
    ++i;
    if (i < word.size() && (word[i] == '+' || word[i] == '-')) ++i;
    const std::size_t begin = i;
    i = skipDigits(word, i);
    if (i == begin) return NumberKind::kNoNumber;
  }
  return i == word.size() ? NumberKind::kFinite : NumberKind::kNoNumber;
}

std::string readTextFile(const std::filesystem::path& path, const CancelToken& cancel) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) {
    throw Error(ErrorKind::kInput, "there is no such file", path.string(), "check the path and its spelling");
  }
  if (fs::is_directory(status)) {
    throw Error(ErrorKind::kInput, "this is a folder, not a file", path.string(), "name a file inside it");
  }
  if (!fs::is_regular_file(status)) {
    throw Error(ErrorKind::kInput, "this is not a regular file", path.string(),
                "copy its contents to a file");
  }
  const std::uintmax_t size = fs::file_size(path, failure);
  std::ifstream stream(path, std::ios::binary);
  if (failure || !stream) {
    throw Error(ErrorKind::kInput, "the file cannot be opened", path.string(), "check its permissions");
  }
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorKind::kInput, "files above 4 GiB are not read", path.string(), "split the scene");
  }
  std::string text(static_cast<std::size_t>(size), '\0');
  std::size_t got = 0;
  for (std::streamsize block = 1; block > 0 && got < text.size();) {
    cancel.check();
    cancel.report(static_cast<double>(got) / static_cast<double>(text.size()));
    stream.read(text.data() + got, static_cast<std::streamsize>(std::min(text.size() - got, kBlock)));
    block = stream.gcount();
    got += static_cast<std::size_t>(block);
  }
  if (stream.bad())
    throw Error(ErrorKind::kInput, "the file cannot be read", path.string(), "check the disk");
  text.resize(got);
  return text;
}

std::string placeOf(const std::filesystem::path& path, std::uint32_t line) {
  return path.string() + ":" + std::to_string(line);
}

std::string counted(std::size_t count, std::string_view singular, std::string_view plural) {
  return std::to_string(count) + " " + std::string(count == 1 ? singular : plural);
}

}  // namespace unshot
