// The lecture on the screen: a panel beside the scene with a page for the matrix, the equation, single shots,
// and what radiosity shows.
#pragma once

#include "viewer/viewer.h"

namespace unshot {

/// What stands beside the scene in a window `width` pixels wide: the lecture, where it is open, takes the
/// place of the side panel unless there is room for both [px].
struct BesideScene {
  int panel = 0, lecture = 0;
  int over = 0;  ///< of a panel that lies over all of it, where that was asked for and it has no room
};
BesideScene besideScene(const Viewer& viewer, int width);
/// Whether the panel finds room in the window as it is.
bool panelHasRoom(const Viewer& viewer);

/// The lecture, from x = `left` on; nothing where it is 0 pixels wide.
void buildLecture(Viewer& viewer, int left, int width);

/// Whether its present page has the hemicube in it.
bool lectureShowsHemicube(const Viewer& viewer);

/// What the mouse is over in it, lit and framed over the scene.
void buildLectureMarks(Viewer& viewer, int scene_width);

// Its pages, in the window that is being built.
void matrixPage(Viewer& viewer);
void equationPage(Viewer& viewer);
void shotsPage(Viewer& viewer);
void effectsPage();

}  // namespace unshot
