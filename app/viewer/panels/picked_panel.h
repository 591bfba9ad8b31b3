// What is picked, and the pinned probes: in the side panel, and marks over the scene.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Nothing where nothing is picked.
void pickedSection(Viewer& viewer);

/// Nothing where none is pinned.
void probesSection(Viewer& viewer);

/// At the picked point, around its patch, and at each probe; in a race over both pictures.
void buildMarks(const Viewer& viewer, int scene_width);

}  // namespace unshot
