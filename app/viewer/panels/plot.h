// A live curve with a logarithmic vertical axis, drawn with ImDrawList (ImGui's own plots have no axes).
#pragma once

#include <imgui.h>

#include <optional>
#include <span>
#include <string>

namespace unshot {

struct PlotPoint {
  double x = 0;
  double y = 0;  ///< values that are not positive are left out
};

/// A second curve over the same axes.
struct PlotCurve {
  std::span<const PlotPoint> points = {};
  const char* label = "";  ///< beside its beginning
  ImVec4 colour{1, 1, 1, 1};
  bool equal = false;  ///< as strong as the first; else fainter, such as a bound of it
  /// At the same x: the lower end of a band below the curve; 0: the band reaches to the bottom. None: no
  /// band.
  std::span<const PlotPoint> low = {};
};

struct PlotStyle {
  const char* x_label = "";    ///< under the axis
  const char* x_unit = "";     ///< after the numbers on the axis: "s" gives 0.5 s
  const char* y_label = "";    ///< over the axis
  std::optional<double> goal;  ///< a dashed line
  bool percent = true;         ///< y as 100 %, 10 %, ...
  float height = 0;            ///< in pixels; 0: five ninths of the width
  PlotCurve second = {};
  const char* name = "";  ///< of the curve: beside it where there is room, and under the mouse
};

/// Draws the curve at ImGui's cursor, as wide as the room there is, with decades, ticks at round numbers and,
/// under the mouse, the values of the nearest point. Over it stands the last value. The points are in the
/// order of their x; thousands are drawn as about two per column of pixels. Copes with no point, with one,
/// and with ranges of any size. Colours: ImGuiCol_PlotLines for the curve, Text and TextDisabled. The font
/// needs raised digits (theme.h).
void logPlot(const char* id, std::span<const PlotPoint> points, const PlotStyle& style);

/// Round steps (1, 2 or 5 times a power of ten) that cut [0, high] into at most `most` parts; 1 where `high`
/// is not positive and finite.
double roundStep(double high, int most);

}  // namespace unshot
