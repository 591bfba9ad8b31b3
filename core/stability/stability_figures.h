// What is measured of a solve, beside what it has to be.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "session/solve.h"

namespace unshot {

/// One figure. Where `expected` is 0 the error is |got|, else |got / expected - 1|.
struct Figure {
  std::string what;
  double got = 0, expected = 0;
  double tolerance = 0;  ///< of the error; 0: exactly
  bool at_most = false;  ///< anything from 0 to `expected` will do

  double error() const;
  bool within() const;
  /// How far into its tolerance: 1 is just within. Infinite where nothing may be off and something is, or
  /// where a figure is not a number.
  double strain() const;
};

/// Which sides of a mesh count.
using SideFilter = std::function<bool(const Mesh&, const Side&)>;
SideFilter everySide();
SideFilter ofMaterial(std::string_view name);
SideFilter frontOf(std::string_view name);

/// How many of the mesh's sides count.
double sidesOf(const Solve& solve, const SideFilter& filter);
/// Area means over the elements of the sides that count, of the state as it is shown [W/m^2]; not a number
/// where there are none.
glm::dvec3 meanRadiosity(const Solve& solve, const SideFilter& filter);
glm::dvec3 meanIrradiance(const Solve& solve, const SideFilter& filter);
/// Of light that came straight from emitters.
glm::dvec3 meanDirectIrradiance(const Solve& solve, const SideFilter& filter);

/// A figure for each channel, in which the mean radiosity has to be `expected`.
std::vector<Figure> meanFigures(const Solve& solve, const std::string& what, const SideFilter& filter,
                                const glm::dvec3& expected, double tolerance);
/// B = `expected` at every element: the mean in each channel, within `of_mean`, and RMS(B - expected) over
/// RMS(expected - E), the error of reflected light, within `of_rms`.
std::vector<Figure> evenFigures(const Solve& solve, const glm::dvec3& expected, double of_mean,
                                double of_rms);
/// The same, where all that counts is exactly `expected`: the value farthest from it, without tolerance.
Figure exactFigure(const Solve& solve, const std::string& what, const SideFilter& filter,
                   const glm::dvec3& expected);
/// Whether the solve has said this (Diagnostic::code): 1 or 0.
Figure saidFigure(const Solve& solve, std::string_view code);

/// Whether every value that the solve shows is a finite number and, where it has converged, none is below 0.
bool stateIsSound(const Solve& solve);

void append(std::vector<Figure>& all, std::vector<Figure> more);

}  // namespace unshot
