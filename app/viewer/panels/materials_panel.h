// The scene's materials in the side panel: what they reflect and emit, to be changed while the solve goes on.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Nothing before the first scene.
void materialsSection(Viewer& viewer);

}  // namespace unshot
