// Reports as JSON (home of nlohmann json in core).
#pragma once

#include <string>
#include <vector>

#include "report/run_record.h"
#include "session/light_walks.h"

namespace unshot {

/// The report of a solve: the fields of the README, two spaces of indentation. Figures that are not measured
/// are null. Text that is not UTF-8 is made so.
std::string reportJson(const RunRecord& record);

/// What `unshot check` finds.
struct CheckRecord {
  Diagnostics diagnostics;
  std::vector<PlanDecision> plan;
  LightWalks walks;
  std::vector<std::string> found_nothing;  ///< keys of the scene checks (session/scene_checks.h) that did
};

/// What `unshot check --json` prints: the scene's figures and the record.
std::string checkJson(const Scene& scene, const CheckRecord& record);

}  // namespace unshot
