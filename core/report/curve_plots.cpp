// Scripts for gnuplot. They name nothing but curves.csv and bounds.csv beside them, so that a folder can be
// moved, and its plots changed by hand.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/csv_table.h"
#include "base/text.h"
#include "report/curve_record.h"
#include "solver/modes.h"

namespace unshot {
namespace {

// M. Okabe and K. Ito, "Color universal design", 2002, with a darker yellow, and grey.
constexpr std::array<std::string_view, 9> kColours{"#000000", "#e69f00", "#56b4e9", "#009e73", "#b8a000",
                                                   "#0072b2", "#d55e00", "#cc79a7", "#888888"};
constexpr std::array<int, 9> kMarks{7, 5, 9, 11, 13, 6, 4, 8, 12};  // of gnuplot

struct Axis {
  const char* column;
  const char* label;
};
constexpr Axis kTime{"cpu_seconds", "busy time [s] (CPU, form factors included)"};
constexpr Axis kRows{"rows", "form-factor rows computed"};

std::size_t rowOf(std::string_view mode) {
  const auto modes = iterationModes();
  const auto found =
      std::find_if(modes.begin(), modes.end(), [&](const auto& row) { return row.info.key == mode; });
  return static_cast<std::size_t>(found - modes.begin());
}

/// Text in single quotes of gnuplot, without markup.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= ' ') out += c == '\'' ? "''" : std::string(1, c);
  }
  return out + "'";
}

/// An error of exactly 0 is drawn as next to none, so that a curve shows its drop to it on a log axis.
std::string series(std::string_view mode, const Axis& x, const char* y, const char* file = "curves.csv") {
  return "'" + std::string(file) + "' using (strcol('mode') eq '" + std::string(mode) + "' ? column('" +
         x.column + "') : NaN):(100*(column('" + y + "')+1e-12))";
}

std::string styleOf(std::string_view mode, const char* with, double width, const char* dash) {
  return std::string(" with ") + with + " lc rgb '" + std::string(modeColour(mode)) + "' lw " +
         figureText(width) + " dt " + dash;
}

std::string plotHead(const CurvePlot& plot, const CurveRecord& record, const Axis& x,
                     const std::string& y_label) {
  const std::string low = figureText(100 * record.options.error / 2);
  return "# " + plot.title + ". In this folder: gnuplot " + plot.name +
         ".gp\n"
         "# Pass -e \"only='svg'\" or \"only='png'\" for one of the two.\n"
         "if (!exists('only')) only = 'svg png'\n"
         "set datafile separator comma\n"
         "set datafile columnheaders\n"
         "set logscale xy\n"
         "set grid xtics ytics mxtics mytics lc rgb '#bbbbbb' lw 0.8, lc rgb '#e4e4e4' lw 0.5\n"
         "set autoscale xfix\n"
         "set border 3 lc rgb '#444444'\n"
         "set tics nomirror\n"
         "set key outside right center vertical Left reverse spacing 1.25 noenhanced\n"
         "set title " +
         quoted(record.scene_name + ": " + plot.title) +
         " noenhanced\n"
         "set xlabel '" +
         x.label + "'\nset ylabel '" + y_label +
         "'\n"
         "set format y '%g %%'\n"
         "set format x '%g'\n"
         "set yrange [" +
         low +
         ":200]\n"
         "do for [kind in only] {\n"
         "  if (kind eq 'svg') { set terminal svg size 960,540 dynamic font 'Helvetica,Arial,sans-serif,15' "
         "background '#ffffff' }\n"
         "  if (kind eq 'png') { set terminal pngcairo size 1440,810 font 'Sans,14' linewidth 1.5 }\n"
         "  set output '" +
         plot.name + ".'.kind\n  plot \\\n";
}

std::string tailOf(const std::vector<std::string>& lines) {
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k)
    text += "    " + lines[k] + (k + 1 < lines.size() ? ", \\\n" : "\n");
  return text + "  unset output\n}\n";
}

/// Error of every mode, its bound as a thin dashed line of the same colour.
CurvePlot errorPlot(const CurveRecord& record, const std::string& name, const std::string& title,
                    const Axis& x, const char* column, const char* bound) {
  CurvePlot plot{name, title, {}, {}};
  std::vector<std::string> lines;
  bool any_bound = false;
  for (const ModeCurve& curve : record.curves) {
    if (curve.points.size() < 2) continue;
    if (bound) {
      any_bound = true;
      lines.push_back(series(curve.mode, x, bound) + styleOf(curve.mode, "lines", 0.8, "2") + " notitle");
    }
    const std::size_t row = rowOf(curve.mode);
    lines.push_back(series(curve.mode, x, column) + styleOf(curve.mode, "linespoints", 2.2, "1") + " pt " +
                    std::to_string(kMarks[row % kMarks.size()]) + " ps 0.8 pi 9 title " + quoted(curve.mode));
  }
  if (any_bound) lines.push_back("NaN with lines lc rgb '#666666' lw 0.8 dt 2 title 'its upper bound'");
  plot.script = plotHead(plot, record, x, "error of the reflected light") + tailOf(lines);
  return plot;
}

/// The end of the same on a linear time axis, where log axes crowd the modes together.
std::optional<CurvePlot> finishPlot(const CurveRecord& record, const char* column, const char* bound) {
  const ErrorMeasure error = mainMeasure(record);
  double first = kNoBound, last = 0;
  for (const ModeCurve& curve : record.curves) {
    const auto begins = costToReach(curve.points, kErrorLevels[0], error.of, busySecondsOf);
    const auto ends = costToReach(curve.points, record.options.error, error.of, busySecondsOf);
    if (begins) first = std::min(first, *begins);
    if (ends) last = std::max(last, *ends);
  }
  if (!(last > first)) return std::nullopt;
  CurvePlot plot = errorPlot(record, "finish_over_time", "the finish", kTime, column, bound);
  plot.caption =
      "The end of the same curves with time on an ordinary axis: who saves form factors arrives early at "
      "coarse errors, who needs all of them drops late but steeply.";
  const std::string before = "do for [kind";
  plot.script.insert(plot.script.find(before), "unset logscale x\nset xrange [" + shortest(first * 0.95) +
                                                   ":" + shortest(last * 1.02) + "]\n");
  return plot;
}

/// What the program knows of its own error, beside the truth, for one mode.
CurvePlot boundsPlot(const CurveRecord& record, const ModeCurve& first) {
  const bool apart = !record.bounded.points.empty();
  const ModeCurve& curve = apart ? record.bounded : first;
  CurvePlot plot{"bounds_over_time",
                 "what " + curve.mode + " knows of its own error",
                 "The program does not know the exact solution while it runs; it knows limits that the error "
                 "cannot leave. Thick: the true error. Dashed: the upper bound, which has to lie above it at "
                 "every moment; for the total error there is one from the first shot on, for the error point "
                 "by point (RMS) once all rows that matter are known.",
                 {}};
  if (apart)
    plot.caption +=
        " This run had full form factors from the start: while some are drafts, the program bounds the error "
        "of the system that it has, which is not the one that the truth is known of.";
  const auto line = [&](const char* column, const std::string& style, const char* title) {
    return series(curve.mode, kTime, column, apart ? "bounds.csv" : "curves.csv") + " with lines " + style +
           " title '" + title + "'";
  };
  std::vector<std::string> lines;
  const std::string blue = "lc rgb '#0072b2' ", red = "lc rgb '#d55e00' ";
  if (record.hasExact()) lines.push_back(line("solver_total_error", blue + "lw 2.5 dt 1", "total, true"));
  lines.push_back(line("solver_total_upper", blue + "lw 1.2 dt 2", "total, upper bound"));
  if (record.hasExact()) lines.push_back(line("solver_error", red + "lw 2.5 dt 1", "RMS, true"));
  lines.push_back(line("solver_upper", red + "lw 1.2 dt 2", "RMS, upper bound"));
  lines.push_back(line("solver_lower", red + "lw 1.2 dt 3", "RMS, lower bound"));
  plot.script = plotHead(plot, record, kTime, "error of the reflected light") + tailOf(lines);
  return plot;
}

}  // namespace

std::string_view modeColour(std::string_view mode) { return kColours[rowOf(mode) % kColours.size()]; }

std::vector<CurvePlot> plotsOf(const CurveRecord& record) {
  std::vector<CurvePlot> plots;
  const auto first = std::find_if(record.curves.begin(), record.curves.end(),
                                  [](const ModeCurve& curve) { return curve.points.size() >= 2; });
  if (first == record.curves.end()) return plots;
  const char* column = record.hasExact() ? "solver_error" : "solver_total_upper";
  const char* bound = record.hasExact() ? "solver_upper" : nullptr;
  const std::string what = record.hasExact() ? "error" : "bound of the total error";
  plots.push_back(errorPlot(record, "error_over_time", what + " against busy time", kTime, column, bound));
  plots.back().caption =
      "Both axes are logarithmic: each grid line to the right is ten times the time, each one down a tenth "
      "of "
      "the error. The curve that is lowest at a moment has the best picture then. Everything counts as busy "
      "time, form factors too.";
  if (auto finish = finishPlot(record, column, bound)) plots.push_back(std::move(*finish));
  plots.push_back(
      errorPlot(record, "error_over_rows", what + " against form-factor rows", kRows, column, bound));
  plots.back().caption =
      "The same runs, counted in rows of form factors, the dear part of radiosity: what one patch sees of "
      "all "
      "others, whatever machine computes it. A vertical drop is work along rows that are already at hand, "
      "which costs none.";
  if (record.hasTotal()) {
    plots.push_back(errorPlot(record, "total_error_over_time", "total error against busy time", kTime,
                              "total_error", nullptr));
    plots.back().caption =
        "Measured against path-traced truth at fixed points. Here every curve ends on the same level: what "
        "is "
        "left is the error of mesh and form factors, which no iteration can take away. To go on solving "
        "beyond the bend is wasted.";
  }
  plots.push_back(boundsPlot(record, *first));
  return plots;
}

}  // namespace unshot
