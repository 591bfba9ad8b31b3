// One scene of a report: measured, and written into its folder.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "cli/interrupt.h"
#include "cli/report_pictures.h"
#include "cli/report_request.h"
#include "report/curve_record.h"
#include "report/page.h"

namespace unshot {

struct MeasuredScene {
  CurveRecord record;
  std::map<std::string, std::string> svg;  ///< plots by name
  ReportPictures pictures;
  std::optional<Error> failure;  ///< the first of a mode; the others are there all the same
};

/// How far the scene is, 0 to 1, and what is being done.
using SceneProgress = std::function<void(double, const std::string&)>;

/// Measures every mode. What an interruption leaves is returned with record.interrupted. Throws Error where
/// nothing can be measured (kInput for a scene that cannot be read, has no light or no finite solution).
MeasuredScene measureScene(const ReportRequest& request, const std::filesystem::path& scene,
                           const std::string& folder, const InterruptFlag& interrupted,
                           const SceneProgress& progress);

/// Writes CSV, JSON and scripts and has the plots drawn. `draw`: gnuplot is there. Throws Error
/// (kEnvironment) for what cannot be written.
void writeScene(const ReportRequest& request, MeasuredScene& scene, bool draw);

}  // namespace unshot
