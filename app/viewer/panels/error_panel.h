// What the side panel says of errors: one number, bars by cause, the curve.
#pragma once

#include <string>

#include "viewer/viewer.h"

namespace unshot {

/// How wrong the picture is; empty before there is a bound or an estimate.
std::string knownError(const LaneState& state);

/// The one number: how wrong the picture is, or what is unshot while that is not known.
std::string errorInFront(const LaneState& state);

/// What is known of the solver's error: "at most 3 %", "no bound yet", with the true one where that is known.
std::string solverText(const Measures& m);

/// From which cause the picture is wrong.
void errorsSection(Viewer& viewer);

/// Unshot light and the error's bound against seconds, shots or rows.
void convergenceSection(Viewer& viewer);

}  // namespace unshot
