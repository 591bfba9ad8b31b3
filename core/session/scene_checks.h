// What may be wrong with a scene as a whole, beyond what its reader and its mesh remark on: one row a check.
// The command line and the viewer show what they find.
#pragma once

#include <span>

#include "base/cancel.h"
#include "base/choice.h"
#include "base/diagnostic.h"
#include "session/checked_scene.h"

namespace unshot {

/// Which checks: those that cost little and matter to every solve, or those that only `unshot check` makes.
enum class CheckTime { kEverySolve, kOnlyCheck };

/// A check. `info.key` is the code of its diagnostics, `info.title` what it looks for.
struct SceneCheckRow {
  ChoiceInfo info;
  CheckTime time = CheckTime::kOnlyCheck;
  Diagnostics (*look)(CheckedScene& scene) = nullptr;
};

std::span<const SceneCheckRow> sceneChecks();

/// What the checks of that time find, in the order of the table.
Diagnostics checkScene(CheckedScene& scene, CheckTime time);

// One a row; what each finds is said in the table's help.
Diagnostics checkLightsThatFaceWalls(CheckedScene& scene);
Diagnostics checkLightsInSolids(CheckedScene& scene);
Diagnostics checkLightsThatSeeNothing(CheckedScene& scene);
Diagnostics checkScale(CheckedScene& scene);
Diagnostics checkNearlyTouching(CheckedScene& scene);
Diagnostics checkWinding(CheckedScene& scene);
Diagnostics checkClosed(CheckedScene& scene);
Diagnostics checkSpectralRadius(CheckedScene& scene);

}  // namespace unshot
