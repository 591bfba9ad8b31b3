// A sub-command and its options: how they are added, and what is checked while they are parsed. Behind it
// stands CLI11, which is slow to compile and therefore stays in options.cpp and command_line.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/choice.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace unshot {

/// Returns what is wrong with a value as typed, or nothing.
using Check = std::function<std::string(const std::string&)>;

/// A finite number from `low` to `high`, or above `low` where `low_excluded`. `unit` follows the limits in
/// the message.
Check numberWithin(double low, double high, const std::string& unit = {}, bool low_excluded = false);
/// A finite number above 0.
Check positiveNumber();
/// A number above 0 and below 1.
Check properFraction();
/// A whole number written in digits.
Check wholeNumber(std::uint64_t low, std::uint64_t high = std::numeric_limits<std::uint64_t>::max(),
                  bool even = false);
/// Three finite numbers "x,y,z".
Check vectorText();
/// "WIDTHxHEIGHT", 1 to `largest` each.
Check sizeText(int largest);
/// Any text that is not empty and not another option that took the place of a value.
Check fileName();

/// "auto, a, b": the keys of a table, for help texts.
template <class Row>
std::string keysOf(std::span<const Row> table, bool with_auto) {
  std::string keys = with_auto ? "auto" : "";
  for (const Row& row : table) keys += (keys.empty() ? "" : ", ") + std::string(row.info.key);
  return keys;
}

/// A key of the table, or "auto" where that is allowed.
template <class Row>
Check keyOf(std::span<const Row> table, bool with_auto) {
  return [table, with_auto](const std::string& key) -> std::string {
    if (with_auto && key == "auto") return {};
    for (const Row& row : table) {
      if (row.info.key == key) return {};
    }
    return "there is no '" + key + "'; it is one of " + keysOf(table, with_auto);
  };
}

/// A sub-command: its arguments, its options and what it does. Values must live as long as it does; they keep
/// what they hold where nothing is given.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(app) {}
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /// Text below the options.
  void footer(const std::string& text);
  /// The heading over the options that are added from now on.
  void group(const std::string& title) { group_ = title; }
  /// A file name that stands without an option before it.
  void argument(const std::string& name, std::string& value, const std::string& help, bool required = true);
  /// One or more of them.
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& help);
  /// Options with a value, shown as `placeholder` in the help. `check` must refuse what is no number for
  /// numbers.
  void add(const std::string& name, std::string& value, const std::string& placeholder,
           const std::string& help, const Check& check);
  void add(const std::string& name, double& value, const std::string& placeholder, const std::string& help,
           const Check& check);
  void add(const std::string& name, std::optional<double>& value, const std::string& placeholder,
           const std::string& help, const Check& check);
  void add(const std::string& name, std::uint32_t& value, const std::string& placeholder,
           const std::string& help, const Check& check);
  void add(const std::string& name, std::uint64_t& value, const std::string& placeholder,
           const std::string& help, const Check& check);
  void add(const std::string& name, std::optional<std::uint64_t>& value, const std::string& placeholder,
           const std::string& help, const Check& check);
  void flag(const std::string& name, bool& value, const std::string& help);
  /// Two options that cannot be given together.
  void exclude(const std::string& one, const std::string& other);
  /// `one` is only given beside `other`.
  void need(const std::string& one, const std::string& other);

  /// What the command does; returns the exit code.
  std::function<int()> run;

 private:
  void addText(const std::string& name, const std::function<void(const std::string&)>& assign,
               const std::string& placeholder, const std::string& help, const Check& check);

  CLI::App& app_;
  std::string group_ = "Options";
};

}  // namespace unshot
