// What the solve left out, with its reasons and switches, in the side panel.
#pragma once

#include <string>
#include <vector>

#include "viewer/viewer.h"

namespace unshot {

/// Something that the present solve left out, or did though the plan would leave it out.
struct PlanLine {
  std::string key;
  std::string title;  ///< in one sentence
  std::string why, saving;
  std::string sure;
  bool left_out = false;
};

/// In the order of the table, so that none moves when it is switched.
std::vector<PlanLine> planLines(const SolveFacts& facts);

/// Nothing where there are none.
void planSection(Viewer& viewer);

}  // namespace unshot
