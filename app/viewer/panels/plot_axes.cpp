#include "viewer/panels/plot_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace unshot {
namespace {

constexpr double kTolerance = 1e-9;    // relative: of steps, and of logarithms
constexpr double kLargest = 4e307;     // positions beyond it count as this, so that differences are finite
constexpr double kMarginBelow = 0.05;  // of the curve's height, so that its end does not lie on the frame
constexpr double kLabelPitch = 1.35;   // from a number to the next, in lines of text
constexpr int kMostPositions = 8;

double logarithm(int digit) { return std::log10(static_cast<double>(digit)); }

/// `digits` times a power of ten, correctly rounded.
double decimal(int digits, int exponent) {
  return std::strtod((std::to_string(digits) + "e" + std::to_string(exponent)).c_str(), nullptr);
}

/// The next of 1, 2 or 5 times a power of ten below (or, with `up`, above) a logarithm.
double roundLogarithm(double value, bool up) {
  const double decade = std::floor(value + kTolerance);
  const double steps[] = {decade, decade + logarithm(2), decade + logarithm(5), decade + 1};
  double below = decade;
  for (double step : steps) {
    if (up && step >= value - kTolerance) return step;
    if (step <= value + kTolerance) below = step;
  }
  return below;
}

/// 1, 2, 3 or 5 times a power of ten: the least that is not below `least`.
int decadeStep(double least) {
  for (int power = 1; power < 100000; power *= 10) {
    for (int digit : {1, 2, 3, 5}) {
      if (digit * power >= least) return digit * power;
    }
  }
  return 100000;
}

std::string raised(int number) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (char digit : std::to_string(std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

/// 12,345.60 with a true minus sign.
std::string grouped(double value, int decimals) {
  char digits[400];
  std::snprintf(digits, sizeof digits, "%.*f", decimals, std::abs(value));
  std::string text = digits;
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  std::size_t comma = std::min(text.find('.'), text.size());
  while (comma > 3) text.insert(comma -= 3, ",");
  return (value < 0 && !zero ? "−" : "") + text;
}

/// mantissa * 10^exponent: as a plain number where that is short, with the digits that the mantissa has.
std::string mantissaText(std::string mantissa, int exponent, int lowest_plain) {
  if (exponent >= lowest_plain && exponent < 6) {
    const int digits_behind = mantissa.size() > 2 ? static_cast<int>(mantissa.size()) - 2 : 0;
    const double plain = std::strtod((mantissa + "e" + std::to_string(exponent)).c_str(), nullptr);
    return grouped(plain, std::max(0, digits_behind - exponent));
  }
  if (mantissa.find('.') != std::string::npos) mantissa.resize(mantissa.find_last_not_of("0.") + 1);
  const std::string power = "10" + raised(exponent);
  return mantissa == "1" ? power : mantissa + "×" + power;
}

/// value * 10^shift with `digits` significant digits.
std::string significant(double value, int shift, int digits, int lowest_plain) {
  if (value == 0) return "0";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*e", digits - 1, std::abs(value));
  const std::string text = buffer;
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;  // no number
  return (value < 0 ? "−" : "") +
         mantissaText(text.substr(0, e), std::atoi(text.c_str() + e + 1) + shift, lowest_plain);
}

/// The number on a line at digit * 10^exponent.
std::string gridText(int digit, int exponent, bool percent) {
  if (percent) return mantissaText(std::to_string(digit), exponent + 2, -3) + " %";
  return (digit == 1 ? "" : std::to_string(digit) + "×") + ("10" + raised(exponent));
}

std::string withUnit(std::string number, const std::string& unit) {
  if (!unit.empty()) number += " " + unit;
  return number;
}

/// The lines at 2 to 9 times a power of ten, as far as there is room.
void addMinorTicks(const AxisRange& range, bool percent, double decade, double line,
                   std::vector<Tick>& ticks) {
  const bool numbers = decade * logarithm(2) >= kLabelPitch * line;
  for (int e = static_cast<int>(std::floor(range.low)); e <= static_cast<int>(std::floor(range.high)); ++e) {
    for (int digit = 2; digit <= 9; ++digit) {
      const double at = e + logarithm(digit);
      if (at < range.low - kTolerance || at > range.high + kTolerance) continue;
      const bool round = digit == 2 || digit == 5;
      if (decade < (round ? 2 : 4) * line) continue;
      ticks.push_back({at, numbers && round ? gridText(digit, e, percent) : "", false});
    }
  }
}

}  // namespace

double roundStep(double high, int most) {
  if (!(high > 0) || !std::isfinite(high)) return 1;
  const double least = high / std::max(1, most);
  const int exponent = static_cast<int>(std::floor(std::log10(least)));
  for (int e = exponent - 1; e <= exponent + 1; ++e) {
    for (int digit : {1, 2, 5}) {
      const double step = decimal(digit, e);
      if (step > 0 && step >= least * (1 - kTolerance)) return step;
    }
  }
  return high;  // beyond the largest power of ten
}

bool isShown(const PlotPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.y > 0;
}

bool areWhole(std::span<const PlotPoint> points) {
  return std::all_of(points.begin(), points.end(), [](const PlotPoint& point) {
    return !isShown(point) || point.x == std::round(point.x);
  });
}

AxisRange valueRange(std::span<const PlotPoint> points, std::optional<double> goal) {
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto include = [&range](double y) {
    range.low = std::min(range.low, std::log10(y));
    range.high = std::max(range.high, std::log10(y));
  };
  for (const PlotPoint& point : points) {
    if (isShown(point)) include(point.y);
  }
  const bool empty = range.low > range.high;
  if (goal && isShown({0, *goal})) include(*goal);
  if (empty) include(1);
  if (empty && range.low == range.high) return {-2, 0};
  range.high = roundLogarithm(range.high, true);
  range.low = roundLogarithm(range.low - kMarginBelow * (range.high - range.low), false);
  if (std::floor(range.high + kTolerance) - std::ceil(range.low - kTolerance) < 1) {
    range = {std::floor(range.low + kTolerance), std::ceil(range.high - kTolerance)};
    if (range.high - range.low < 1) range.low = range.high - 1;
  }
  return range;
}

AxisRange positionRange(std::span<const PlotPoint> points) {
  AxisRange range{0, 0};
  for (const PlotPoint& point : points) {
    if (!isShown(point)) continue;
    range.low = std::max(-kLargest, std::min(range.low, point.x));
    range.high = std::min(kLargest, std::max(range.high, point.x));
  }
  if (!(range.high - range.low >= std::numeric_limits<double>::min())) range.high = range.low + 1;
  return range;
}

std::vector<Tick> valueTicks(const AxisRange& range, bool percent, double height, double line) {
  std::vector<Tick> ticks;
  const double decade = height / (range.high - range.low);
  const int step = decadeStep(kLabelPitch * line / decade);
  const int last = static_cast<int>(std::floor(range.high + kTolerance));
  for (int e = static_cast<int>(std::ceil(range.low - kTolerance)); e <= last; ++e) {
    const bool major = e % step == 0;
    if (major || decade >= 0.4 * line) {
      ticks.push_back({static_cast<double>(e), major ? gridText(1, e, percent) : "", major});
    }
  }
  if (step == 1) addMinorTicks(range, percent, decade, line, ticks);
  return ticks;
}

std::vector<Tick> positionTicks(const AxisRange& range, const PositionStyle& style, double width, double gap,
                                const TextWidth& text_width) {
  const double length = range.high - range.low;
  double step = 1;
  std::function<std::string(double)> text;
  for (int most = kMostPositions; most >= 1; --most) {
    step = roundStep(length, most);
    if (style.whole) step = std::max(1.0, step);
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + kTolerance)));
    const bool plain = std::max(range.high, -range.low) < 1e7 && decimals <= 4;
    text = [=, &style](double x) {
      return withUnit(x == 0 ? "0" : plain ? grouped(x, decimals) : significant(x, 0, 2, 0), style.unit);
    };
    double widest = 0;
    for (double end : {range.low, range.high}) {
      widest = std::max(widest, text_width(text(std::trunc(end / step) * step)));
    }
    if (widest + gap <= step / length * width) break;
  }
  std::vector<Tick> ticks;
  for (double k = std::ceil(range.low / step - kTolerance); k <= range.high / step + kTolerance; ++k) {
    ticks.push_back({k * step, text(k * step), true});
  }
  return ticks;
}

std::string valueText(double value, bool percent, int digits) {
  return significant(value, percent ? 2 : 0, digits, -3) + (percent ? " %" : "");
}

std::string shortValueText(double value, bool percent) {
  char one[64], two[64];
  std::snprintf(one, sizeof one, "%.0e", value);
  std::snprintf(two, sizeof two, "%.1e", value);
  const bool same = std::strtod(one, nullptr) == std::strtod(two, nullptr);
  return valueText(value, percent, same ? 1 : 2);
}

std::string positionText(double x, const std::string& unit) {
  const bool whole = x == std::round(x) && std::abs(x) < 1e12;
  return withUnit(whole ? grouped(x, 0) : significant(x, 0, 3, -3), unit);
}

std::vector<ImVec2> thinnedOut(std::span<const ImVec2> pixels) {
  std::vector<ImVec2> kept;
  const auto keep = [&](std::size_t i) {
    if (kept.empty() || kept.back().x != pixels[i].x || kept.back().y != pixels[i].y)
      kept.push_back(pixels[i]);
  };
  std::size_t begin = 0;
  while (begin < pixels.size()) {
    const float column = std::floor(pixels[begin].x);
    std::size_t low = begin, high = begin, end = begin;
    for (; end < pixels.size() && std::floor(pixels[end].x) == column; ++end) {
      if (pixels[end].y < pixels[low].y) low = end;
      if (pixels[end].y > pixels[high].y) high = end;
    }
    if (begin == 0) keep(0);
    keep(std::min(low, high));
    keep(std::max(low, high));
    if (end == pixels.size()) keep(end - 1);
    begin = end;
  }
  return kept;
}

}  // namespace unshot
