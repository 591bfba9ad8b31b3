// The record of a scene as tables.
#include <algorithm>

#include "base/csv_table.h"
#include "report/curve_record.h"

namespace unshot {
namespace {

std::optional<double> boundOf(const CurvePoint& point) {
  const double bound = point.bounds.upper < kNoBound ? point.bounds.upper : point.bounds.total_upper;
  return bound < kNoBound ? std::optional(bound) : std::nullopt;
}

std::optional<double> leastBusySecondsOf(const CurvePoint& point) { return point.cpu_seconds_min; }
std::optional<double> mostBusySecondsOf(const CurvePoint& point) { return point.cpu_seconds_max; }

/// Empty where there is no value.
std::string cell(std::optional<double> value) { return value && *value < kNoBound ? shortest(*value) : ""; }

std::string countCell(std::uint64_t value) { return std::to_string(value); }

std::string lineOf(std::initializer_list<std::string> cells) {
  std::string line;
  for (const std::string& text : cells) line += (line.empty() ? "" : ",") + text;
  return line + "\n";
}

}  // namespace

bool CurveRecord::hasTotal() const {
  return std::any_of(curves.begin(), curves.end(), [](const ModeCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(),
                       [](const CurvePoint& p) { return p.total_error.has_value(); });
  });
}

std::vector<ErrorMeasure> measuresOf(const CurveRecord& record) {
  std::vector<ErrorMeasure> out;
  if (record.hasExact()) out.push_back({"solver", "solver error", solverErrorOf});
  if (record.hasTotal()) out.push_back({"total", "total error", totalErrorOf});
  out.push_back({"bound", "bound of the solver error", boundOf});
  return out;
}

ErrorMeasure mainMeasure(const CurveRecord& record) { return measuresOf(record).front(); }

namespace {

std::string csvOf(std::span<const ModeCurve> curves) {
  std::string text =
      "# seconds: wall [s]; cpu_seconds: busy time, median over the repeats [s]; errors, bounds and unshot: "
      "fractions of 1;\n"
      "# solver_error, _upper, _lower: RMS; solver_total_error, _upper: sums; no bounds while form factors "
      "are "
      "drafts\n"
      "# rows: form-factor columns and rows computed; total_error: against the path-traced reference\n"
      "mode,point,step,shots,rows,cpu_seconds,cpu_seconds_min,cpu_seconds_max,seconds,unshot_fraction,"
      "solver_error,solver_lower,solver_upper,solver_total_error,solver_total_upper,total_error\n";
  for (const ModeCurve& curve : curves) {
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      const CurvePoint& p = curve.points[k];
      text +=
          lineOf({curve.mode, countCell(k), countCell(p.step), countCell(p.shots), countCell(p.rows),
                  cell(p.cpu_seconds), cell(p.cpu_seconds_min), cell(p.cpu_seconds_max), cell(p.seconds),
                  cell(p.unshot_fraction), cell(solverErrorOf(p)), cell(p.bounds.lower), cell(p.bounds.upper),
                  cell(solverTotalErrorOf(p)), cell(p.bounds.total_upper), cell(p.total_error)});
    }
  }
  return text;
}

}  // namespace

std::string curvesCsv(const CurveRecord& record) { return csvOf(record.curves); }

std::string boundsCsv(const CurveRecord& record) {
  return record.bounded.points.empty() ? std::string() : csvOf({&record.bounded, 1});
}

std::string tableCsv(const CurveRecord& record) {
  std::string text =
      "# what it cost to come down to `level` (fraction of 1) of an error; empty: not reached; seconds [s]\n"
      "mode,error,level,cpu_seconds,cpu_seconds_min,cpu_seconds_max,rows,shots,memory_bytes,runs\n";
  for (const ModeCurve& curve : record.curves) {
    for (const ErrorMeasure& error : measuresOf(record)) {
      for (const double level : kErrorLevels) {
        const auto cost = [&](const PointQuantity& of) {
          return cell(costToReach(curve.points, level, error.of, of));
        };
        text += lineOf({curve.mode, std::string(error.key), shortest(level), cost(busySecondsOf),
                        cost(leastBusySecondsOf), cost(mostBusySecondsOf), cost(rowsOf), cost(shotsOf),
                        countCell(curve.memoryBytes()), countCell(curve.runs.size())});
      }
    }
  }
  return text;
}

}  // namespace unshot
