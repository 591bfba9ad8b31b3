// What is said on standard output after a solve.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "report/run_record.h"

namespace unshot {

/// "what: why (saving)".
std::string planText(const PlanDecision& decision);

/// Short and aligned; `written` are the files written.
void printSummary(std::ostream& out, const RunRecord& record, const SolveOptions& options,
                  const std::vector<std::string>& written);

}  // namespace unshot
