// The line to type in over the scene and its list.
#pragma once

namespace unshot {

class Viewer;

/// Nothing where no prompt is open. `middle` of the scene's width, and the y that it begins at [px].
void buildPrompt(Viewer& viewer, float middle, float top);
/// How high it is with a few rows [px].
float leastPromptHeight();

}  // namespace unshot
