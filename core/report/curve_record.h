// Everything that `unshot report` says about a scene, as plain values, and its files as text.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/curve_runs.h"
#include "report/error_curves.h"
#include "report/run_record.h"
#include "report/scene_figures.h"

namespace unshot {

/// The path-traced reference of a scene.
struct ReferenceRecord {
  std::size_t points = 0;
  double noise = 0, median_noise = 0;  ///< its own errors (noiseOf, medianNoiseOf)
  double seconds = 0;
  bool from_file = false;
  std::string file;  ///< name in the folder of the report
};

struct CurveRecord {
  std::filesystem::path scene_path;
  std::string scene_name;
  std::string folder;  ///< name of the scene's own in the folder of the report
  SceneFigures scene;
  CurveRuns::Figures solve;
  SolveOptions options;
  std::size_t repeats_asked = 1;
  std::optional<GlRecord> gl;  ///< nothing where no GL was needed
  ExactSolution exact;
  std::optional<ReferenceRecord> reference;
  std::vector<ModeCurve> curves;  ///< one per mode asked for, as far as the report came
  /// The first of them again, without drafts of form factors; no points where it had none.
  ModeCurve bounded;
  std::vector<std::string> notes;
  std::size_t peak_memory_bytes = 0;
  bool interrupted = false;

  bool hasExact() const { return !exact.radiosity.empty(); }
  bool hasTotal() const;
};

/// An error that curves are measured in: key, name for people, and how to read it.
struct ErrorMeasure {
  std::string_view key, title;
  std::optional<double> (*of)(const CurvePoint&);
};

/// Those that the record has: "solver" (true), "total" (against the reference), "bound" (what the program
/// knows by itself).
std::vector<ErrorMeasure> measuresOf(const CurveRecord& record);
/// The first of them: what tables and words are about.
ErrorMeasure mainMeasure(const CurveRecord& record);

/// One line per mode and point. A comment line gives the units.
std::string curvesCsv(const CurveRecord& record);
/// The same of `bounded`; empty where that has no points.
std::string boundsCsv(const CurveRecord& record);
/// One line per mode, error and level: what it cost to get there, empty where it was not reached.
std::string tableCsv(const CurveRecord& record);
/// The same and more as JSON (curve_json.cpp).
std::string curvesJson(const CurveRecord& record);

/// A plot of the report: NAME.gp makes NAME.svg and NAME.png of curves.csv, or bounds.csv, in its own folder.
struct CurvePlot {
  std::string name, title, caption, script;
};
std::vector<CurvePlot> plotsOf(const CurveRecord& record);

/// Colour of a mode in plots and page, "#rrggbb": one for each row of the table of modes, told apart with any
/// colour vision.
std::string_view modeColour(std::string_view mode);

}  // namespace unshot
