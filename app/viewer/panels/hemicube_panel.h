// The hemicube of a patch as the five faces that every lecture draws, live.
#pragma once

#include "viewer/panels/lower_edge.h"
#include "viewer/viewer.h"

namespace unshot {

/// Its window over the scene at the lower left, where it is open and finds room.
void buildHemicube(Viewer& viewer, LowerEdge& edge);

/// The part of the panel that opens it and the lecture.
void teachingSection(Viewer& viewer);

/// The cross and what is to be said of it, `side` pixels wide, in the window that is being built.
void hemicubeContent(Viewer& viewer, float side);

/// "no. 12, white".
std::string patchText(const Mesh& mesh, std::uint32_t patch);

}  // namespace unshot
