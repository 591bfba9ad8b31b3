// The help over the scene: mouse and keys.
#pragma once

namespace unshot {

/// `middle` of the scene's width [px].
void buildHelp(float middle);

}  // namespace unshot
