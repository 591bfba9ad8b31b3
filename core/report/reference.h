// A path-traced reference: the true radiosity at fixed points of a scene, with its standard error, for total
// errors of solutions.
//
// Independent of mesh, form factors and solver: it knows the scene's polygons alone. How it is traced stands
// in report/path_tracer.h. The standard error of a point comes from the spread of the means of its batches of
// paths; it is itself uncertain by 1 / sqrt(2 (batches - 1)) of its size, and too small where light that
// matters comes by ways so rare that no path has found them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace unshot {

/// Where a reference is wanted, in the file's own coordinates; the normal (any length) says which side.
struct ReferencePlace {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};
};

struct ReferencePoint {
  glm::dvec3 position{0.0};        ///< in the file's own coordinates
  glm::dvec3 normal{0.0};          ///< unit length, points away from the side
  glm::dvec3 reflectance{0.0};     ///< rho
  glm::dvec3 emission{0.0};        ///< E [W/m^2] of this side
  glm::dvec3 radiosity{0.0};       ///< B [W/m^2], with E
  glm::dvec3 standard_error{0.0};  ///< of B [W/m^2]; infinite with fewer than two batches of paths
  std::uint64_t samples = 0;       ///< paths
  std::string material;            ///< name

  glm::dvec3 reflected() const { return radiosity - emission; }
};

struct Reference {
  std::vector<ReferencePoint> points;
  double seconds = 0;      ///< wall time spent on it, in all runs that it was put together from
  bool from_file = false;  ///< nothing had to be traced
  Diagnostics diagnostics;
};

struct ReferenceOptions {
  std::size_t points = 256;
  std::uint64_t seed = 1;
  bool emit_front_only = false;
  glm::dvec3 sky{0.0};  ///< its radiosity [W/m^2]
  /// Traced until RMS(standard error) / RMS(reflected radiosity) is no larger, and the median over points of
  /// standard error / reflected radiosity no larger than twice it; or until a limit is met.
  double relative_error = 0.01;
  std::optional<double> max_seconds;
  std::uint64_t max_samples = 1u << 22;  ///< paths per point
  unsigned threads = 0;                  ///< 0: as many as the machine has
  /// These places in place of random ones.
  std::vector<ReferencePlace> places;
  /// Called now and then on the calling thread with the fraction done, 0 to 1. Returns false to stop: what
  /// was reached is returned.
  std::function<bool(double)> progress;
};

/// The points of the options, without paths: random, uniform over the area of all surface sides that
/// reflect, do not emit and are reached by light (found by a few paths); of emitting sides where there are no
/// others. Throws Error: kInput where nothing emits, where no light reaches anything that reflects, where a
/// place lies on no surface, or where walls absorb nothing and let nothing out (no finite solution).
std::vector<ReferencePoint> chooseReferencePoints(const Scene& scene, const ReferenceOptions& options);

/// Traces the reference. Without max_seconds and progress the result depends on scene and options alone, not
/// on the number of threads. Throws as chooseReferencePoints does.
Reference traceReference(const Scene& scene, const ReferenceOptions& options);

/// More paths for a reference of the same scene and options (all but the limits): the result is the one that
/// would have come from tracing all of it at once. Sets `diagnostics` anew.
void continueReference(const Scene& scene, const ReferenceOptions& options, Reference& reference);

/// RMS(standard error) / RMS(reflected radiosity) over points and channels: the reference's own nRMSE.
/// Infinite where some point has no standard error; 0 without points.
double noiseOf(std::span<const ReferencePoint> points);

/// Median over the points that reflect light of |standard error| / |reflected radiosity|: where a few points
/// are far brighter than the rest, noiseOf speaks of those alone. Infinite and 0 as there.
double medianNoiseOf(std::span<const ReferencePoint> points);

}  // namespace unshot
