// Building blocks of command-line options: how they are added, and what is checked while they are parsed.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "base/choice.h"

namespace unshot {

/// Returns what is wrong with a value as typed, or nothing.
using Check = std::function<std::string(const std::string&)>;

/// A finite number from `low` to `high`, or above `low` where `low_excluded`. `unit` follows the limits in
/// the message.
Check numberWithin(double low, double high, const std::string& unit = {}, bool low_excluded = false);
/// A finite number above 0.
Check positiveNumber();
/// A whole number written in digits.
Check wholeNumber(std::uint64_t low, std::uint64_t high = std::numeric_limits<std::uint64_t>::max(),
                  bool even = false);
/// Three finite numbers "x,y,z".
Check vectorText();
/// "WIDTHxHEIGHT", 1 to 16384 each.
Check sizeText();
/// Any text that is not empty and not another option that took the place of a value.
Check fileName();

/// Adds an option whose value is shown as `placeholder` in the help.
template <class Value>
CLI::Option* addOption(CLI::App& app, const std::string& name, Value& value, const std::string& placeholder,
                       const std::string& help, const Check& check) {
  return app.add_option(name, value, help)->option_text(placeholder)->check(check);
}

/// Adds a file name that must be given and needs no option before it.
CLI::Option* addFileArgument(CLI::App& app, const std::string& name, std::string& value,
                             const std::string& help);

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

}  // namespace unshot
