// What lies over and beside the scene, built with ImGui from the viewer's state. Everything a panel changes
// goes through a named action.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// Width of the side panel in a window `width` pixels wide; 0 where it is hidden or the window is too
/// small for it.
int panelWidth(const ViewerState& ui, double scale, int width);

/// How wide a window has to be for it [px].
int leastWindowWithPanel(double scale);

/// The panel at the right edge, from x = `left` on; nothing where that is the edge itself.
void buildSidePanel(Viewer& viewer, int left);

/// Messages, help and what is being loaded, over the scene's `scene_width` pixels, down to y = `bottom`.
/// Without `notices` what is under way is left out, and the lines that tell of files written and the like: of
/// no use in a picture.
void buildOverlays(Viewer& viewer, int scene_width, float bottom, bool notices, bool framing);

}  // namespace unshot
