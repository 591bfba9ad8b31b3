// The real window: GLFW events in, frames out, at most 60 a second and only when something has changed.
#pragma once

#include <optional>

#include "viewer/viewer.h"

namespace unshot {

struct WindowOptions {
  int width = 1280, height = 800;  ///< [screen units]
  bool size_given = false;         ///< else fitted to the screen
};

/// Opens the viewer and returns when it is closed, with an exit code. `setup` without contexts, wake and
/// resize, which the window provides. Main thread. Throws Error kEnvironment where no window can be opened;
/// its advice names the command that needs none.
int runWindow(ViewerSetup setup, const WindowOptions& options);

}  // namespace unshot
