// The line of the panel that says which scene is shown, and opens others.
#pragma once

namespace unshot {

class Viewer;

void chooseScene(Viewer& viewer);

/// What the scene is, the sky around it, and which sides of its lights emit.
void sceneSection(Viewer& viewer);

}  // namespace unshot
