// Path-traced reference values at points of a scene, and the error figures held against them: of reflected
// light only, at points with E = 0.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "export/probes.h"
#include "report/reference_error.h"
#include "report/reference_file.h"

namespace unshot::testing_support {

using Truth = std::vector<ReferencePoint>;
using Values = std::vector<std::optional<glm::dvec3>>;

/// RMS(error) / RMS(truth) over points that do not shine, and channels. One value per point; a point without
/// a value counts with B = 0.
inline double reflectedError(const Truth& truth, const Values& values) {
  return errorAgainst(truth, values).nrmse_raw;
}

/// The check that a picture of bounced light must pass.
inline bool isFaithful(const Truth& truth, const Values& values, double tolerance) {
  return reflectedError(truth, values) <= tolerance;
}

inline std::vector<Probe> probesOf(const Truth& truth) {
  std::vector<Probe> out;
  for (const ReferencePoint& point : truth) out.push_back({point.position, point.normal});
  return out;
}

inline std::vector<ReferencePlace> placesOf(const Truth& truth) {
  std::vector<ReferencePlace> out;
  for (const ReferencePoint& point : truth) out.push_back({point.position, point.normal});
  return out;
}

inline Values valuesOf(const Truth& truth) {
  Values out;
  for (const ReferencePoint& point : truth) out.emplace_back(point.radiosity);
  return out;
}

}  // namespace unshot::testing_support
