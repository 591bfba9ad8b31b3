// Numbers from text, whatever the locale.
#pragma once

#include <charconv>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace unshot {

/// `text` without blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// The parts of `text` between `separator`s, without blanks at their ends; one empty part for an empty text.
inline std::vector<std::string_view> splitParts(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t end = 0;
  while ((end = text.find(separator)) != std::string_view::npos) {
    parts.push_back(trimmed(text.substr(0, end)));
    text.remove_prefix(end + 1);
  }
  parts.push_back(trimmed(text));
  return parts;
}

/// The number that the whole of `text` spells (a leading + is allowed; "nan" and "inf" are numbers), else
/// nothing.
inline std::optional<double> parseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "x,y,z", else nothing.
inline std::optional<glm::dvec3> parseVector(std::string_view text) {
  const std::vector<std::string_view> parts = splitParts(text, ',');
  if (parts.size() != 3) return std::nullopt;
  glm::dvec3 vector{0.0};
  for (int k = 0; k < 3; ++k) {
    const std::optional<double> value = parseNumber(parts[static_cast<std::size_t>(k)]);
    if (!value) return std::nullopt;
    vector[k] = *value;
  }
  return vector;
}

}  // namespace unshot
