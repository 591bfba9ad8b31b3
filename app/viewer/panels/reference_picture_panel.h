// A picture from elsewhere over that of the scene: its rows in the panel, the line between both, and how far
// they are apart.
#pragma once

#include "viewer/panels/lower_edge.h"
#include "viewer/viewer.h"

namespace unshot {

/// Rows of the panel; nothing where no picture is loaded.
void referencePictureChoices(Viewer& viewer);

/// The line, which can be dragged and ends at y = `bottom`, with names at its sides or a scale, and the
/// figure, over the scene.
void buildReferencePicture(Viewer& viewer, float bottom, LowerEdge& edge);

}  // namespace unshot
