// What the figures of a scene show, in sentences that can be read out. Text is plain.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "report/page.h"

namespace unshot {
namespace {

// Costs that differ by less than this share count as equal.
constexpr double kSame = 0.05;

struct Entry {
  const ModeCurve* curve;
  double cost, rows, shots, seconds;
};

/// The modes that come down to the level, cheapest first.
std::vector<Entry> ranking(const CurveRecord& record, double level, const PointQuantity& cost) {
  const ErrorMeasure error = mainMeasure(record);
  std::vector<Entry> out;
  for (const ModeCurve& curve : record.curves) {
    const auto of = [&](const PointQuantity& q) { return costToReach(curve.points, level, error.of, q); };
    if (const auto reached = of(cost))
      out.push_back({&curve, *reached, *of(rowsOf), *of(shotsOf), *of(busySecondsOf)});
  }
  std::stable_sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) { return a.cost < b.cost; });
  return out;
}

/// "southwell", "southwell and overshoot": those as good as the first.
std::string leaders(const std::vector<Entry>& ranked) {
  std::string text;
  std::vector<std::string> names;
  for (const Entry& entry : ranked) {
    if (entry.cost <= (1 + kSame) * ranked.front().cost) names.push_back(entry.curve->mode);
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

std::string perRow(const CurveRecord& record, double level) {
  const std::vector<Entry> ranked = ranking(record, level, rowsOf);
  if (ranked.empty()) return "No mode came down to " + percentText(level) + ".";
  const Entry &first = ranked.front(), &last = ranked.back();
  if (last.cost <= (1 + kSame) * first.cost) {
    return "Per row, to " + percentText(level) + ": all take about the same, " +
           roundedCountText(first.rows) +
           " rows. Where light that matters leaves from nearly every patch, no choice of order saves rows.";
  }
  return "Per row, to " + percentText(level) + ": " + leaders(ranked) + " first, with " +
         roundedCountText(first.rows) + " rows; " + last.curve->mode + " takes " +
         roundedCountText(last.rows) + ". " +
         (first.curve->mode == "southwell" || first.curve->mode == "kept-first" ||
                  first.curve->mode == "overshoot"
              ? "It asks for a row only when much light waits to be shot along it; modes that sweep ask for "
                "every row in the first bounce, most of which carry little."
              : "How it goes: " + first.curve->help + ".");
}

std::string perSecond(const CurveRecord& record, double level) {
  const std::vector<Entry> ranked = ranking(record, level, busySecondsOf);
  if (ranked.empty()) return {};
  const Entry &first = ranked.front(), &last = ranked.back();
  std::string text = "Per second, to " + percentText(level) + ": " + leaders(ranked) + " first, in " +
                     durationText(first.seconds) + "; the slowest that gets there is " + last.curve->mode +
                     " with " + durationText(last.seconds) + ". ";
  double rows_of_all = 0;
  for (const Entry& entry : ranked) rows_of_all = std::max(rows_of_all, entry.rows);
  if (first.rows < (1 - kSame) * rows_of_all) {
    text += "It saves form factors: " + roundedCountText(first.rows) + " rows in place of " +
            roundedCountText(rows_of_all) + ".";
  } else if (last.shots > 1.5 * first.shots) {
    text += "All of them need nearly all rows; what differs is the work along rows at hand: " +
            roundedCountText(first.shots) + " shots against " + roundedCountText(last.shots) + ".";
  } else {
    text += "All of them need nearly all rows, so the time of computing these decides, and it is the same.";
  }
  return text;
}

/// What share of the time form factors take.
std::string formFactorShare(const CurveRecord& record) {
  double low = 1, high = 0;
  for (const ModeCurve& curve : record.curves) {
    if (curve.points.empty() || !(curve.runs.front().cpu_seconds.back() > 0)) continue;
    const double share = std::min(1.0, curve.form_factor_seconds / curve.runs.front().cpu_seconds.back());
    low = std::min(low, share);
    high = std::max(high, share);
  }
  if (high < low) return {};
  const auto whole = [](double share) { return std::to_string(std::lround(100 * share)); };
  const std::string range = whole(low) == whole(high) ? whole(low) : whole(low) + " to " + whole(high);
  return "Form factors take " + range +
         " % of the whole busy time, depending on the mode: mostly they decide what a solution costs.";
}

}  // namespace

std::vector<std::string> whoWins(const CurveRecord& record) {
  std::vector<std::string> out;
  for (const double level : {0.1, 0.01, 0.001}) {
    for (const std::string& text : {perRow(record, level), perSecond(record, level)}) {
      if (!text.empty() && (out.empty() || out.back() != text)) out.push_back(text);
    }
  }
  const std::string share = formFactorShare(record);
  if (!share.empty()) out.push_back(share);
  for (const ModeCurve& curve : record.curves) {
    if (!curve.left_out.empty()) out.push_back(curve.mode + " is left out: " + curve.left_out + ".");
    if (curve.failure)
      out.push_back(curve.mode + " ended early: " + curve.failure->what() + ".");
    else if (curve.stopped_by == "max_seconds")
      out.push_back(curve.mode + " was ended by the limit of time.");
  }
  return out;
}

}  // namespace unshot
