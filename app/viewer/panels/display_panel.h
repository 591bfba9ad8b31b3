// What of the light is shown, and how bright: a section of the panel.
#pragma once

namespace unshot {

class Viewer;

void displaySection(Viewer& viewer);

}  // namespace unshot
