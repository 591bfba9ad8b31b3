// What the window says of a race: two solves of the same scene in two iteration modes.
#pragma once

#include <imgui.h>

#include "viewer/viewer.h"

namespace unshot {

/// The colour of a solve in a race: of its curve, and of the dot before its name.
ImVec4 raceColour(bool rival);

/// The header of a part of the panel that is about the present solve alone: in a race it says so.
bool sectionOfLeft(const char* title, const SessionState& state);

/// The row of the panel that begins and ends a race.
void chooseRival(Viewer& viewer);

/// Over each picture the mode it was made with and how far that is; nothing without a race.
void buildRaceLabels(Viewer& viewer, int scene_width);

/// How far each is, in a line under the curves; nothing without a race.
void raceStandings(const SessionState& state);

}  // namespace unshot
