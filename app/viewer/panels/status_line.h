// The slim line at the bottom of the scene: what the solve does, how far it is, how fast, and what draws it.
#pragma once

#include <imgui.h>

#include <string>

#include "viewer/viewer.h"

namespace unshot {

/// What the solve is doing, in a word, and the colour that stands for it.
struct PhaseLook {
  std::string text;
  ImVec4 colour;
};
PhaseLook phaseLook(const SessionState& state);

/// Draws it over the scene's `scene_width` pixels, each figure at a place of its own; what has no room is
/// left out, the last first. Returns its height [px]: 0 where it is hidden, as it is with the panel.
float buildStatusLine(Viewer& viewer, int scene_width);

}  // namespace unshot
