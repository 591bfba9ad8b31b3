// What the side panel says of the scene: what is doubtful about it, and what was left out.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Doubts about the scene where some are warnings: a heading that is seen without scrolling.
void warningsSection(Viewer& viewer);

/// What the plan left out, and notes where there are no warnings.
void notesSection(Viewer& viewer);

}  // namespace unshot
