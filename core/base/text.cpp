#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace unshot {
namespace {

// Light is kept in single precision: parts smaller than these are its rounding.
constexpr double kNoFraction = 1e-9;

std::string formatted(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string wholeText(double value) { return formatted("%.0f", value); }

}  // namespace

std::string numberText(double value) { return formatted("%.9g", value); }

std::string countText(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::ptrdiff_t place = std::ssize(text) - 3; place > 0; place -= 3) {
    text.insert(static_cast<std::size_t>(place), ",");
  }
  return text;
}

std::string roundedCountText(double count) {
  return countText(static_cast<std::uint64_t>(std::llround(count)));
}

std::string figureText(double value) {
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (!std::isfinite(value) || size < 1e-4 || size >= 1e6) return formatted("%.3g", value);
  const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
  std::string text = buffer;
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string percentText(double fraction) {
  return figureText(std::abs(fraction) < kNoFraction ? 0 : 100 * fraction) + " %";
}

std::string durationText(double seconds) {
  if (!(seconds >= 0) || seconds > 1e9) return "?";
  if (seconds < 0.0995) return figureText(std::round(1e4 * seconds) / 10) + " ms";
  if (seconds < 1) return formatted("%.3f s", seconds);
  if (seconds < 99.95) return formatted(seconds < 9.995 ? "%.2f s" : "%.1f s", seconds);
  const double minutes = std::floor(seconds / 60);
  if (minutes < 60)
    return wholeText(minutes) + " min " + wholeText(std::floor(seconds - 60 * minutes)) + " s";
  const double hours = std::floor(minutes / 60);
  return wholeText(hours) + " h " + wholeText(minutes - 60 * hours) + " min";
}

std::string memoryText(double bytes) {
  if (bytes < 1e6) return figureText(bytes / 1e3) + " kB";
  if (bytes < 1e9) return figureText(bytes / 1e6) + " MB";
  return figureText(bytes / 1e9) + " GB";
}

std::string extentText(const glm::dvec3& extent) {
  return figureText(extent.x) + " x " + figureText(extent.y) + " x " + figureText(extent.z);
}

std::string countedText(std::uint64_t count, const std::string& one, const std::string& many) {
  return countText(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

}  // namespace unshot
