// The table of actions in its parts, one file each.
#pragma once

#include <span>

#include "viewer/actions/actions.h"

namespace unshot {

std::span<const Action> solveActions();
std::span<const Action> materialActions();
std::span<const Action> displayActions();
std::span<const Action> lectureActions();
std::span<const Action> cameraActions();
std::span<const Action> pickingActions();
std::span<const Action> windowActions();

}  // namespace unshot
