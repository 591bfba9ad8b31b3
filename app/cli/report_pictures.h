// Pictures of every mode at equal busy times and at equal numbers of rows, for the page of a report.
#pragma once

#include <string>
#include <vector>

#include "cli/gl_context.h"
#include "report/curve_runs.h"
#include "report/page.h"

namespace unshot {

struct ReportPictures {
  std::string solution;  ///< PNG; empty: none
  std::vector<PictureTable> tables;
  std::string why_not;  ///< they were left out
};

/// All from one place and with one exposure, without the ambient term. Takes `max_seconds` at most; modes
/// beyond it have no pictures.
ReportPictures makePictures(const CurveRecord& record, CurveRuns& runs, LazyContext& context,
                            double max_seconds, const RunWatch& watch);

}  // namespace unshot
