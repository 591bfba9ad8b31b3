// False colours in the window: their legend over the scene, and their choices in the panel.
#pragma once

#include "viewer/panels/lower_edge.h"
#include "viewer/viewer.h"

namespace unshot {

/// Rows of the panel; nothing where the display mode shows no false colours.
void falseColourChoices(Viewer& viewer);

/// The scale with round values and its unit, over the scene's lower right; nothing in other modes.
void buildFalseColourLegend(const Viewer& viewer, LowerEdge& edge);

}  // namespace unshot
