#include "cli/report_pictures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/clock.h"
#include "base/srgb.h"
#include "base/text.h"
#include "base/tone.h"
#include "export/image_files.h"
#include "render/picture.h"

namespace unshot {
namespace {

constexpr int kWidth = 240, kHeight = 180;
constexpr double kFractions[] = {0.05, 0.15, 0.4, 1};     // of the time that the quickest takes
constexpr double kRowFractions[] = {0.05, 0.1, 0.25, 1};  // of all rows

/// The costs at which pictures are taken: of busy time, or of rows.
struct Stops {
  std::vector<double> costs;
  PointQuantity cost;
};

/// The time in which the quickest mode comes down to 1 %, or as far as any comes.
double quickest(const CurveRecord& record) {
  const ErrorMeasure error = mainMeasure(record);
  for (const double level : {0.01, 0.03, 0.1}) {
    double least = kNoBound;
    for (const ModeCurve& curve : record.curves) {
      if (const auto t = costToReach(curve.points, level, error.of, busySecondsOf))
        least = std::min(least, *t);
    }
    if (least < kNoBound) return least;
  }
  double last = 0;
  for (const ModeCurve& curve : record.curves) {
    if (!curve.points.empty()) last = std::max(last, curve.points.back().cpu_seconds);
  }
  return last;
}

Stops timeStops(const CurveRecord& record) {
  Stops stops{{}, busySecondsOf};
  const double all = quickest(record);
  for (const double f : kFractions) stops.costs.push_back(f * all);
  return stops;
}

Stops rowStops(const CurveRecord& record) {
  double all = 0;
  for (const ModeCurve& curve : record.curves) {
    if (!curve.points.empty()) all = std::max(all, static_cast<double>(curve.points.back().rows));
  }
  Stops stops{{}, rowsOf};
  for (const double f : kRowFractions) stops.costs.push_back(std::round(f * all));
  return stops;
}

/// Takes all pictures with the first one's camera and exposure.
class Photographer {
 public:
  Photographer(LazyContext& context) : context_(context) {
    options_.width = kWidth, options_.height = kHeight;
  }

  std::string take(const Solve& solve) {
    const Snapshot snapshot = solve.snapshot();
    const Picture picture = renderPicture(context_.get(), snapshot, options_);
    if (!options_.eye) {
      const glm::dvec3 origin = snapshot.mesh->frame_origin;
      options_.eye = origin + picture.camera.eye;
      options_.at = origin + picture.camera.at;
      options_.up = picture.camera.up;
      options_.fov_deg = picture.camera.fov_deg;
      exposure_ = picture.exposure;
      return pngBytes(picture.srgb);
    }
    Image8 shown{kWidth, kHeight, {}};
    shown.rgb.reserve(picture.linear.rgb.size());
    for (std::size_t k = 0; k + 2 < picture.linear.rgb.size(); k += 3) {
      const float* rgb = &picture.linear.rgb[k];
      const glm::dvec3 tone = toneMap(exposure_ * glm::dvec3(rgb[0], rgb[1], rgb[2]));
      for (int c = 0; c < 3; ++c) shown.rgb.push_back(srgb8FromLinear(tone[c]));
    }
    return pngBytes(shown);
  }

 private:
  LazyContext& context_;
  PictureOptions options_;
  double exposure_ = 1;
};

std::string captionOf(const CurveRecord& record, const CurvePoint& point) {
  const ErrorMeasure error = mainMeasure(record);
  const auto e = error.of(point);
  const std::string wrong = !e ? "error unknown" : (error.key == "bound" ? "at most " : "") + percentText(*e);
  return wrong + ", " + countedText(point.rows, "row");
}

PictureTable emptyTable(const std::string& title, const std::string& text,
                        const std::vector<std::string>& columns) {
  return {title, text, columns, {}};
}

/// Rows of both tables for one mode, from one more run of it.
void addMode(const CurveRecord& record, const ModeCurve& curve, const std::vector<Stops>& stops,
             CurveRuns& runs, Photographer& photographer, std::vector<PictureTable>& tables,
             const RunWatch& watch) {
  std::map<std::uint64_t, std::string> at_step;
  std::vector<std::vector<std::size_t>> points;
  for (const Stops& s : stops) {
    points.emplace_back();
    for (const double cost : s.costs) {
      points.back().push_back(pointAtCost(curve.points, cost, s.cost));
      at_step[curve.points[points.back().back()].step];
    }
  }
  std::vector<std::uint64_t> steps;
  for (const auto& entry : at_step) steps.push_back(entry.first);
  runs.statesAt(
      curve.mode, steps,
      [&](std::size_t k, const Solve& solve) { at_step[steps[k]] = photographer.take(solve); }, watch);
  for (std::size_t t = 0; t < tables.size(); ++t) {
    PictureTable::Row row{curve.mode, {}};
    for (const std::size_t p : points[t])
      row.cells.push_back({at_step[curve.points[p].step], captionOf(record, curve.points[p])});
    tables[t].rows.push_back(std::move(row));
  }
}

}  // namespace

ReportPictures makePictures(const CurveRecord& record, CurveRuns& runs, LazyContext& context,
                            double max_seconds, const RunWatch& watch) {
  ReportPictures out;
  const auto best = std::min_element(record.curves.begin(), record.curves.end(),
                                     [&](const ModeCurve& a, const ModeCurve& b) {
                                       const auto left = [](const ModeCurve& c) {
                                         return c.points.empty() ? kNoBound : c.points.back().unshot_fraction;
                                       };
                                       return left(a) < left(b);
                                     });
  if (best == record.curves.end() || best->points.empty()) return out;
  const double began = wallSeconds();
  const std::vector<Stops> stops{timeStops(record), rowStops(record)};
  std::vector<std::string> times, rows;
  for (const double t : stops[0].costs) times.push_back("at " + durationText(t));
  for (std::size_t k = 0; k < stops[1].costs.size(); ++k)
    rows.push_back(countText(static_cast<std::uint64_t>(stops[1].costs[k])) + " rows (" +
                   percentText(kRowFractions[k]) + ")");
  out.tables = {
      emptyTable(
          "The pictures at equal times",
          "What each mode could show after the same busy time, all from one place and with one exposure, "
          "as solved: without any estimate of the light still under way. Black means that no light has "
          "come there yet.",
          times),
      emptyTable("The pictures at equal rows", "The same after the same number of form-factor rows.", rows)};
  try {
    Photographer photographer(context);
    const std::uint64_t last = best->points.back().step;
    runs.statesAt(
        best->mode, {&last, 1},
        [&](std::size_t, const Solve& solve) { out.solution = photographer.take(solve); }, watch);
    if (out.solution.empty()) return {{}, {}, "they were interrupted"};
    for (const ModeCurve& curve : record.curves) {
      if (curve.points.empty() || !watch(0)) continue;
      if (wallSeconds() - began > max_seconds) {
        out.why_not = "the time for this scene was up before those of " + curve.mode;
        break;
      }
      addMode(record, curve, stops, runs, photographer, out.tables, watch);
    }
  } catch (const Error& error) {
    return {{}, {}, error.what()};
  }
  std::erase_if(out.tables, [](const PictureTable& table) { return table.rows.empty(); });
  return out;
}

}  // namespace unshot
