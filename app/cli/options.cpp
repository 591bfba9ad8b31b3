#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "base/parse.h"
#include "cli/text.h"

namespace unshot {
namespace {

std::optional<std::uint64_t> parseWhole(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string quoted(const std::string& text) { return "'" + text + "'"; }

}  // namespace

Check numberWithin(double low, double high, const std::string& unit, bool low_excluded) {
  return [=](const std::string& text) -> std::string {
    const std::optional<double> value = parseNumber(text);
    if (!value || std::isnan(*value)) return quoted(text) + " is not a number";
    if (*value <= high && (low_excluded ? *value > low : *value >= low) && std::isfinite(*value)) return {};
    const std::string end = unit.empty() ? "" : " " + unit;
    if (high >= std::numeric_limits<double>::max()) {
      return text + " is not " + (low_excluded ? "above " : "at least ") + figureText(low) + end;
    }
    return text + " is not " + (low_excluded ? "above " : "from ") + figureText(low) +
           (low_excluded ? " and at most " : " to ") + figureText(high) + end;
  };
}

Check positiveNumber() { return numberWithin(0, std::numeric_limits<double>::max(), {}, true); }

Check properFraction() {
  return [](const std::string& text) -> std::string {
    const std::optional<double> value = parseNumber(text);
    if (!value) return quoted(text) + " is not a number";
    return *value > 0 && *value < 1 ? "" : text + " is not above 0 and below 1";
  };
}

Check wholeNumber(std::uint64_t low, std::uint64_t high, bool even) {
  return [=](const std::string& text) -> std::string {
    const std::optional<std::uint64_t> value = parseWhole(text);
    if (!value) return quoted(text) + " is not a whole number";
    if (*value < low || *value > high) {
      if (high == std::numeric_limits<std::uint64_t>::max())
        return text + " is not at least " + countText(low);
      return text + " is not from " + countText(low) + " to " + countText(high);
    }
    return even && *value % 2 == 1 ? text + " is not even" : "";
  };
}

Check vectorText() {
  return [](const std::string& text) -> std::string {
    const std::optional<glm::dvec3> v = parseVector(text);
    if (!v) return quoted(text) + " is not x,y,z (three numbers with commas, no blanks)";
    if (!std::isfinite(v->x) || !std::isfinite(v->y) || !std::isfinite(v->z))
      return quoted(text) + " is not finite";
    return {};
  };
}

Check sizeText(int largest) {
  return [=](const std::string& text) -> std::string {
    const std::vector<std::string_view> parts = splitParts(text, 'x');
    if (parts.size() != 2) return quoted(text) + " is not WIDTHxHEIGHT, such as 800x600";
    for (const std::string_view part : parts) {
      const std::optional<std::uint64_t> value = parseWhole(part);
      if (!value) return quoted(text) + " is not WIDTHxHEIGHT, such as 800x600";
      if (*value < 1 || *value > static_cast<std::uint64_t>(largest)) {
        const std::string limit = std::to_string(largest);
        return quoted(text) + " is not from 1x1 to " + limit + "x" + limit;
      }
    }
    return {};
  };
}

Check fileName() {
  return [](const std::string& text) -> std::string {
    if (text.empty()) return "the name is empty";
    if (text.starts_with("--"))
      return "a file name is missing before " + text + " (write ./" + text + " for a file of that name)";
    return {};
  };
}

void Command::footer(const std::string& text) { app_.footer(text); }

void Command::argument(const std::string& name, std::string& value, const std::string& help, bool required) {
  app_.add_option(name, value, help)->option_text(" ")->check(fileName())->required(required);
}

void Command::arguments(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  app_.add_option(name, values, help)->option_text(" ")->check(fileName())->required();
}

void Command::addText(const std::string& name, const std::function<void(const std::string&)>& assign,
                      const std::string& placeholder, const std::string& help, const Check& check) {
  app_.add_option_function<std::string>(name, assign, help)
      ->option_text(placeholder)
      ->check(check)
      ->group(group_);
}

void Command::add(const std::string& name, std::string& value, const std::string& placeholder,
                  const std::string& help, const Check& check) {
  addText(
      name, [&value](const std::string& text) { value = text; }, placeholder, help, check);
}

void Command::add(const std::string& name, double& value, const std::string& placeholder,
                  const std::string& help, const Check& check) {
  addText(
      name, [&value](const std::string& text) { value = *parseNumber(text); }, placeholder, help, check);
}

void Command::add(const std::string& name, std::optional<double>& value, const std::string& placeholder,
                  const std::string& help, const Check& check) {
  addText(
      name, [&value](const std::string& text) { value = parseNumber(text); }, placeholder, help, check);
}

void Command::add(const std::string& name, std::uint32_t& value, const std::string& placeholder,
                  const std::string& help, const Check& check) {
  const auto assign = [&value](const std::string& text) {
    value = static_cast<std::uint32_t>(*parseWhole(text));
  };
  addText(name, assign, placeholder, help, check);
}

void Command::add(const std::string& name, std::uint64_t& value, const std::string& placeholder,
                  const std::string& help, const Check& check) {
  addText(
      name, [&value](const std::string& text) { value = *parseWhole(text); }, placeholder, help, check);
}

void Command::add(const std::string& name, std::optional<std::uint64_t>& value,
                  const std::string& placeholder, const std::string& help, const Check& check) {
  addText(
      name, [&value](const std::string& text) { value = parseWhole(text); }, placeholder, help, check);
}

void Command::flag(const std::string& name, bool& value, const std::string& help) {
  app_.add_flag(name, value, help)->group(group_);
}

void Command::exclude(const std::string& one, const std::string& other) {
  app_.get_option(one)->excludes(app_.get_option(other));
}

void Command::need(const std::string& one, const std::string& other) {
  app_.get_option(one)->needs(app_.get_option(other));
}

}  // namespace unshot
