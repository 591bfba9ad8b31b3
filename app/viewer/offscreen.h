// The viewer without a window: scripts only, for machines without a display and for tests.
#pragma once

#include <string>

#include "viewer/viewer.h"

namespace unshot {

/// Runs the script to its end and returns the exit code. `setup` without contexts, wake and resize.
/// `provider` makes the contexts (gl::createContext). Throws Error.
int runOffscreen(ViewerSetup setup, const std::string& provider, int width, int height);

}  // namespace unshot
