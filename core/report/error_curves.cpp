#include "report/error_curves.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solver/counted.h"

namespace unshot {
namespace {

// An error that falls by more than this factor between neighbouring points has jumped.
constexpr double kJump = 2;

double sum(const glm::dvec3& x) { return x.x + x.y + x.z; }

double medianOf(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

SolverError solverError(const Mesh& mesh, std::span<const glm::dvec3> radiosity,
                        std::span<const glm::dvec3> exact) {
  std::vector<glm::dvec3> emission, reflectance;  // of sides
  for (const Side& side : mesh.sides) {
    emission.push_back(side.emission);
    reflectance.push_back(side.reflectance);
  }
  const std::vector<char> counts = whereErrorsCount(emission, reflectance);
  double squares = 0, reflected_squares = 0, absolute = 0, reflected = 0;
  for (std::uint32_t q = 0; q < mesh.patch_count; ++q) {
    const std::uint32_t side = mesh.patch_side[q];
    if (!counts[side]) continue;
    const glm::dvec3 error = radiosity[q] - exact[q], light = exact[q] - emission[side];
    const double area = mesh.patch_area[q];
    squares += area * glm::dot(error, error);
    reflected_squares += area * glm::dot(light, light);
    absolute += area * sum(glm::abs(error));
    reflected += area * sum(light);
  }
  if (!(reflected_squares > 0)) return {};
  return {std::sqrt(squares / reflected_squares), absolute / reflected};
}

void takeMedians(ModeCurve& curve) {
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    std::vector<double> cpu, wall;
    for (const RunTimes& run : curve.runs) {
      if (k >= run.cpu_seconds.size()) continue;
      cpu.push_back(run.cpu_seconds[k]);
      wall.push_back(run.seconds[k]);
    }
    if (cpu.empty()) continue;
    CurvePoint& point = curve.points[k];
    point.cpu_seconds_min = *std::min_element(cpu.begin(), cpu.end());
    point.cpu_seconds_max = *std::max_element(cpu.begin(), cpu.end());
    point.cpu_seconds = medianOf(std::move(cpu));
    point.seconds = medianOf(std::move(wall));
  }
}

std::optional<double> solverErrorOf(const CurvePoint& point) {
  return point.solver ? std::optional(point.solver->nrmse) : std::nullopt;
}
std::optional<double> solverTotalErrorOf(const CurvePoint& point) {
  return point.solver ? std::optional(point.solver->total) : std::nullopt;
}
std::optional<double> totalErrorOf(const CurvePoint& point) { return point.total_error; }
std::optional<double> busySecondsOf(const CurvePoint& point) { return point.cpu_seconds; }
std::optional<double> rowsOf(const CurvePoint& point) { return static_cast<double>(point.rows); }
std::optional<double> shotsOf(const CurvePoint& point) { return static_cast<double>(point.shots); }

std::optional<double> costToReach(std::span<const CurvePoint> points, double level,
                                  const PointQuantity& error, const PointQuantity& cost) {
  const CurvePoint* before = nullptr;
  for (const CurvePoint& point : points) {
    const std::optional<double> e = error(point), x = cost(point);
    if (!e || !x) continue;
    if (*e > level) {
      before = &point;
      continue;
    }
    if (!before) return x;
    const double e0 = *error(*before), x0 = *cost(*before);
    if (e0 > kJump * *e || !(x0 > 0) || !(*e > 0)) return x;
    return x0 * std::pow(*x / x0, std::log(e0 / level) / std::log(e0 / *e));
  }
  return std::nullopt;
}

std::size_t pointAtCost(std::span<const CurvePoint> points, double cost, const PointQuantity& cost_of) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::optional<double> here = cost_of(points[k]);
    if (here && *here <= cost) at = k;
  }
  return at;
}

}  // namespace unshot
