// The camera's part of the panel.
#pragma once

namespace unshot {

class Viewer;

void cameraSection(Viewer& viewer);

}  // namespace unshot
