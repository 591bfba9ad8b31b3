// The table of trials: scenes whose answer is known exactly, and what a solve of each has to show.
//
// Tolerances are those of the default mode and method. Every other mode and form-factor method is held to the
// same ones; where one cannot keep them the row names it as an exception, with the reason.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "session/solve.h"
#include "stability/stability_figures.h"

namespace unshot {

/// A mode or form-factor method that is known not to keep a case's tolerance. It is run all the same, and
/// fails beyond what is known.
struct KnownException {
  std::string_view key;
  std::string_view reason;
  /// How many times the tolerance it is off at most; 0: it stops short, and says why.
  double most = 0;
};

struct StabilityCase {
  std::string key;
  std::string title;     ///< the scene, in words
  std::string expected;  ///< what has to come out, in words
  std::function<Scene()> make;
  /// Fineness, error asked for, sides that emit; mode, method and time are the runner's.
  SolveOptions options;
  std::function<std::vector<Figure>(const Solve&)> measure = {};
  std::vector<KnownException> exceptions = {};
  bool no_solution = false;  ///< a solve has to end as failed, and say that there is no finite solution
  bool large = false;        ///< takes minutes in some modes
  bool slow = false;         ///< takes thousands of sweeps: seconds in most modes
  /// Wall time at which a solve counts as one that does not end; on two cores to themselves all but the large
  /// take a tenth of it.
  double most_seconds = 30;
};

/// Passes over all patches by which a scene without a finite solution must have been found out: what is
/// unshot is held against what it was every twenty passes, and a pass of some modes is two.
inline constexpr double kMostPasses = 100;

std::span<const StabilityCase> stabilityCases();

}  // namespace unshot
