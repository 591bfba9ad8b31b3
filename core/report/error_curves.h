// How the error of an iteration mode falls with time and with form-factor rows: plain values, and what is
// read off them.
//
// Errors are those of the solver: of the patches' radiosity B = S + U against the exact solution B* of the
// same discrete system, where errors count (solver/counted.h), weighted by area.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "mesh/mesh.h"
#include "solver/bounds.h"

namespace unshot {

/// The errors that tables are made for.
inline constexpr double kErrorLevels[] = {0.1, 0.03, 0.01, 0.003, 0.001};

struct SolverError {
  double nrmse = 0;  ///< RMS(B - B*) / RMS(B* - E)
  double total = 0;  ///< sum A |B - B*| / sum A (B* - E)
};

/// `radiosity` and `exact`: B and B*, one per patch of the mesh [W/m^2]. 0 where nothing is reflected.
SolverError solverError(const Mesh& mesh, std::span<const glm::dvec3> radiosity,
                        std::span<const glm::dvec3> exact);

struct CurvePoint {
  std::uint64_t step = 0;  ///< of the solve; the same in every repeat
  std::uint64_t shots = 0, rows = 0;
  double cpu_seconds = 0;  ///< busy time since meshing began: median over the repeats
  double cpu_seconds_min = 0, cpu_seconds_max = 0;
  double seconds = 0;  ///< wall time: median over the repeats
  double unshot_fraction = 1;
  /// Nothing while form factors are drafts: bounds are of the system at hand, errors of that of full ones.
  SolverBounds bounds;
  std::optional<SolverError> solver;  ///< where the exact solution is at hand
  std::optional<double> total_error;  ///< nRMSE against a reference, where it was measured at this point
};

/// The times of one repeat, one per point that it came to.
struct RunTimes {
  std::vector<double> cpu_seconds, seconds;
};

struct ModeCurve {
  std::string mode, title, help;
  std::string left_out;  ///< why there is no curve; empty: there is one
  std::vector<CurvePoint> points;
  std::vector<RunTimes> runs;
  std::string stopped_by;
  bool drafts = false;                ///< whether form factors were drafts on the way
  std::optional<Error> failure;       ///< what ended it
  double form_factor_seconds = 0;     ///< of the busy time at the last point, first run
  std::size_t kept_bytes = 0;         ///< of form factors, at the end
  std::size_t working_bytes_max = 0;  ///< of state and mode
  std::string why_not_judgeable;      ///< of the last total error; empty: the reference is good enough

  std::size_t memoryBytes() const { return kept_bytes + working_bytes_max; }
};

/// Fills in the medians and spreads of `curve.points` from `curve.runs`. A point counts those runs that came
/// to it.
void takeMedians(ModeCurve& curve);

/// What a point has of a quantity; nothing where it was not measured there.
using PointQuantity = std::function<std::optional<double>(const CurvePoint&)>;

// Those that are asked for most.
std::optional<double> solverErrorOf(const CurvePoint& point);
std::optional<double> solverTotalErrorOf(const CurvePoint& point);
std::optional<double> totalErrorOf(const CurvePoint& point);
std::optional<double> busySecondsOf(const CurvePoint& point);
std::optional<double> rowsOf(const CurvePoint& point);
std::optional<double> shotsOf(const CurvePoint& point);

/// The cost at which the error first comes down to `level`, between points as a straight line on log axes;
/// but where it falls by more than half from a point to the next it falls at the latter. Nothing where it is
/// not reached.
std::optional<double> costToReach(std::span<const CurvePoint> points, double level,
                                  const PointQuantity& error, const PointQuantity& cost);

/// The last point that does not cost more than `cost`; the first one where all do. `points` not empty.
std::size_t pointAtCost(std::span<const CurvePoint> points, double cost, const PointQuantity& cost_of);

}  // namespace unshot
