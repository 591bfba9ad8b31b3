// What the side panel says of light by bounces: how much each holds, and which are shown.
#pragma once

#include <string>
#include <vector>

#include "viewer/viewer.h"

namespace unshot {

/// The power of bounce k over that of the one before, channels summed; `k` from 1 on, below the size.
double bounceRatio(const std::vector<glm::dvec3>& power, std::size_t k);

/// A bounce in words: how much of the light emitted it holds, and of the bounce before.
std::string bounceText(const std::vector<glm::dvec3>& power, std::size_t k);

/// Bars of the power of each bounce, and the choice of how many are shown, in the window that is being built.
void bouncesContent(Viewer& viewer);
/// The same as a section of the panel.
void bouncesSection(Viewer& viewer);

}  // namespace unshot
