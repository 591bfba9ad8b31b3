// False colours in the window: their legend over the scene, and their choices in the panel.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Rows of the panel; nothing where the display mode shows no false colours.
void falseColourChoices(Viewer& viewer);

/// The scale with round values and its unit, over the scene's lower right, above y = `bottom`; nothing in
/// other modes.
void buildFalseColourLegend(const Viewer& viewer, int scene_width, float bottom);

}  // namespace unshot
