// The one exception of the program: bad input or environment, worded for the person at the keyboard.
#pragma once

#include <stdexcept>
#include <string>

namespace unshot {

/// What went wrong; decides the exit code (design: 0 done, 1 internal, 2 usage, 3 input, 4 environment).
enum class ErrorKind { kInternal, kUsage, kInput, kEnvironment };

/// Thrown for bad input or environment. `what` is the message; `where` names file or file:line (may be
/// empty); `advice` says what to try (may be empty).
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message, std::string where = {}, std::string advice = {})
      : std::runtime_error(message), kind_(kind), where_(std::move(where)), advice_(std::move(advice)) {}

  ErrorKind kind() const { return kind_; }
  const std::string& where() const { return where_; }
  const std::string& advice() const { return advice_; }

  /// "where: message" and, on a second line, the advice.
  std::string fullText() const {
    std::string text = where_.empty() ? std::string(what()) : where_ + ": " + what();
    if (!advice_.empty()) text += "\n  try: " + advice_;
    return text;
  }

 private:
  ErrorKind kind_;
  std::string where_;
  std::string advice_;
};

/// The exception in flight, worded for the person at the keyboard. To be called in a catch block.
Error presentError();

}  // namespace unshot
