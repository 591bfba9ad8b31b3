// The text layer that OBJ and MTL share: files, logical lines, tokens, and a tally for diagnostics.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/cancel.h"
#include "base/diagnostic.h"

namespace unshot {

/// A line with its continuations joined, without line end, byte order mark and surrounding blanks.
struct LogicalLine {
  std::string_view text;   ///< valid until the next call of LineReader::next
  std::uint32_t line = 0;  ///< where it begins in the file, counted from 1
};

/// Cuts a text into logical lines: ends are LF, CRLF or CR; a backslash at the end joins the next line; blank
/// lines and lines of comment are passed over.
class LineReader {
 public:
  explicit LineReader(std::string_view text);
  bool next(LogicalLine& line);

 private:
  std::string_view physicalLine();

  std::string_view rest_;
  std::uint32_t line_ = 0;
  std::string joined_;
};

/// Takes the next word (up to blank or tab) off `rest`; empty at the end.
std::string_view takeWord(std::string_view& rest);

/// At its ends: blanks, tabs, vertical tabs and form feeds.
std::string_view withoutBlanks(std::string_view text);

/// Without a comment: up to a # that begins the text or follows a blank.
std::string_view withoutComment(std::string_view text);

enum class NumberKind { kFinite, kInfinite, kNegativeInfinite, kNan, kNoNumber };

/// What a word is as a number: [+-]digits[.digits][e[+-]digits], inf, nan, or nothing of the kind. Knows no
/// locale. A finite word may still overflow to infinity when it is read.
NumberKind numberKind(std::string_view word);

/// The whole file. Throws Error (kInput: missing, not a regular file, unreadable, larger than 4 GiB).
std::string readTextFile(const std::filesystem::path& path, const CancelToken& cancel = {});

/// "path:line".
std::string placeOf(const std::filesystem::path& path, std::uint32_t line);

/// "1 face", "3 faces".
std::string counted(std::size_t count, std::string_view singular, std::string_view plural);

/// How often something was found, and where first.
struct Tally {
  std::size_t count = 0;
  std::uint32_t first_line = 0;

  void add(std::uint32_t line) {
    if (count++ == 0) first_line = line;
  }
};

}  // namespace unshot
