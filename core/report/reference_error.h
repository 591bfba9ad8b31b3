// Total error of a solution against a path-traced reference.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/reference.h"

namespace unshot {

/// Errors of reflected light B - E at the reference's points with E = 0 (at all of them where every point
/// emits), over points and channels, each with the same weight. A point without a value counts with B = 0.
/// Relative errors are of points whose reflected light is above 1 % of the mean: RMS over channels of the
/// error over that of the reference.
struct ReferenceError {
  std::size_t points = 0;   ///< compared
  std::size_t missing = 0;  ///< of them, without a value
  double nrmse = 0;         ///< RMS(error) / RMS(reference), without the share of the reference's own noise
  double nrmse_raw = 0;     ///< with it
  double noise = 0;         ///< RMS(standard error) / RMS(reference)
  double bias = 0;          ///< mean(error) / mean(reference)
  double median = 0;        ///< of the relative errors
  double worst_5 = 0;       ///< mean of the largest 5 % of the relative errors (one at least)
};

/// `values`: B [W/m^2] with E, one per point (export/probes.h has them from a snapshot).
ReferenceError errorAgainst(std::span<const ReferencePoint> reference,
                            std::span<const std::optional<glm::dvec3>> values);

/// Whether the reference is good enough for what is held against it: no more noise than a third of the error
/// (then it changes nrmse_raw by less than 6 %).
bool isJudgeable(const ReferenceError& error);

/// Why not, and what to try, in one sentence; empty where it is.
std::string whyNotJudgeable(const ReferenceError& error);

}  // namespace unshot
