// What the axes of a plot show: ranges, ticks and their texts, and how many points are worth drawing. No
// drawing here.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewer/panels/plot.h"

namespace unshot {

struct AxisRange {
  double low = 0;
  double high = 1;
};

struct Tick {
  double at = 0;
  std::string text;  ///< empty: a line without a number
  bool major = true;
};

/// Whether a logarithmic plot can show the point.
bool isShown(const PlotPoint& point);

/// The decimal logarithms that the vertical axis spans: all points and the goal, out to 1, 2 or 5 times a
/// power of ten, and at least one whole decade.
AxisRange valueRange(std::span<const PlotPoint> points, std::optional<double> goal);

/// The horizontal axis: from 0 (or the lowest x below it) to the highest x.
AxisRange positionRange(std::span<const PlotPoint> points);

/// Decades of a vertical axis `height` pixels high, whose text is `line` pixels high: numbers on as many as
/// there is room for, lines without a number between them. `at` is a logarithm.
std::vector<Tick> valueTicks(const AxisRange& range, bool percent, double height, double line);

struct PositionStyle {
  std::string unit;    ///< after each number
  bool whole = false;  ///< whole numbers only, as for counts
};

using TextWidth = std::function<double(const std::string&)>;

/// Round positions of a horizontal axis `width` pixels wide, with at least `gap` pixels between their texts.
std::vector<Tick> positionTicks(const AxisRange& range, const PositionStyle& style, double width, double gap,
                                const TextWidth& text_width);

/// Whether every position is a whole number.
bool areWhole(std::span<const PlotPoint> points);

/// A value with `digits` significant digits: "12.3 %", "10⁻⁷ %"; without percent "0.123".
std::string valueText(double value, bool percent, int digits);

/// The same with two digits, or one where the second is 0.
std::string shortValueText(double value, bool percent);

/// A position as the mouse shows it: a whole number as it is, others with three significant digits.
std::string positionText(double x, const std::string& unit);

/// Of the points in each column of pixels the lowest and the highest, in their order, and the first and the
/// last of all.
std::vector<ImVec2> thinnedOut(std::span<const ImVec2> pixels);

}  // namespace unshot
