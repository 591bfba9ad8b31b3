// The line of the panel that says which scene is shown, and opens others.
#pragma once

namespace unshot {

class Viewer;

void chooseScene(Viewer& viewer);

}  // namespace unshot
