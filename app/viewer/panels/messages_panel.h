// What the viewer has said of late, at the end of the panel.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Nothing where nothing was said.
void messagesSection(Viewer& viewer);

}  // namespace unshot
