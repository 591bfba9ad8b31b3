// The help over the scene: mouse and keys.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// `middle` of the scene's width [px].
void buildHelp(const Viewer& viewer, float middle);

}  // namespace unshot
