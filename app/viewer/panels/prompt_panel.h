// The line to type in over the scene and its list.
#pragma once

namespace unshot {

class Viewer;

/// Nothing where no prompt is open. `middle` of the scene's width [px].
void buildPrompt(Viewer& viewer, float middle);

}  // namespace unshot
