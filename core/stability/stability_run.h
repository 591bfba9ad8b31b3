// Runs a case of the stability suite by one iteration mode and one form-factor method.
#pragma once

#include <functional>
#include <string>

#include "base/cancel.h"
#include "stability/stability_cases.h"

namespace unshot {

enum class Verdict {
  kPass,
  kRefused,    ///< the program says by itself that mode or method is not for this scene
  kException,  ///< not within its tolerance, which the table of cases knows, with a reason
  kFail
};

std::string_view nameOf(Verdict verdict);

/// What a case is solved on.
enum class Fineness {
  kEven,  ///< the even mesh that the case names, its error the solver's
  /// A mesh that follows the light, as fine as kLightError asks for: what a solve does without options, held
  /// to the case's tolerance or to kLightTolerance where that is more.
  kLight
};
inline constexpr double kLightError = 0.01;
/// Of single figures: the error asked for is a mean over the scene, and an estimate.
inline constexpr double kLightTolerance = 1.5 * kLightError;

std::string_view nameOf(Fineness fineness);

struct StabilityResult {
  std::string case_key;
  Fineness fineness = Fineness::kEven;
  std::string mode, form_factors;  ///< what `auto` became; as asked for where there is no solve
  Figure figure;                   ///< the one farthest into its tolerance, or beyond
  double seconds = 0;              ///< wall time, with scene and mesh
  Verdict verdict = Verdict::kFail;
  std::string note;  ///< why, unless it is kPass
};

/// Solves the case and measures. `mode` and `form_factors` are keys of their tables or "auto"; `gl` as
/// Solve's. A solve that fails, stops short or cannot begin is a result, not an exception; throws Cancelled
/// where `cancel` asks for it.
StabilityResult runStability(const StabilityCase& trial, const std::string& mode,
                             const std::string& form_factors, const std::function<gl::Context&()>& gl,
                             Fineness fineness = Fineness::kEven, const CancelToken& cancel = {});

}  // namespace unshot
