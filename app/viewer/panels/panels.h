// What lies over and beside the scene, built with ImGui from the viewer's state. Everything a panel changes
// goes through a named action.
#pragma once

#include "viewer/panels/lower_edge.h"
#include "viewer/viewer.h"

namespace unshot {

/// Width of the side panel [px].
int panelWidth(double scale);

/// How wide a window has to be for it [px].
int leastWindowWithPanel(double scale);

/// The panel at the right edge, from x = `left` on; nothing where that is the edge itself.
void buildSidePanel(Viewer& viewer, int left);

/// Where names of pictures at the scene's upper edge end; 0 where there are none.
float belowNames(const Viewer& viewer);

/// Messages, help and what is being loaded, over the scene and what stands along its lower edge. `covered`:
/// the panel lies over the scene. Without `notices` what is under way is left out, and the lines that tell of
/// files written and the like: of no use in a picture. `looks`: a first camera is looked for, and has been
/// for more than a moment.
void buildOverlays(Viewer& viewer, const LowerEdge& edge, bool covered, bool notices, bool looks);

}  // namespace unshot
