// What the side panel says of the scene: what is doubtful about it.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Doubts about the scene where some are warnings: a heading that is seen without scrolling.
void warningsSection(Viewer& viewer);

/// Notes where there are no warnings.
void notesSection(Viewer& viewer);

}  // namespace unshot
