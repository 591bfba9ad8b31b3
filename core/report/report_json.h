// Reports as JSON (home of nlohmann json in core).
#pragma once

#include <string>
#include <vector>

#include "report/run_record.h"

namespace unshot {

/// The report of a solve: the fields of the README, two spaces of indentation. Figures that are not measured
/// are null. Text that is not UTF-8 is made so.
std::string reportJson(const RunRecord& record);

/// What `unshot check --json` prints: the scene's figures, the diagnostics and the plan.
std::string checkJson(const Scene& scene, const Diagnostics& diagnostics,
                      const std::vector<PlanDecision>& plan);

}  // namespace unshot
