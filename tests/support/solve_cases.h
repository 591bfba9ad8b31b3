// Solves of every kind that end in a moment, for what interrupts them: saving, editing.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string_view>
#include <vector>

#include "session/solve.h"

namespace unshot::testing_support {

struct SolveCase {
  std::string_view method, mode;
  bool follows_light = false;
  std::size_t kept_bytes = std::size_t{1} << 30;
  bool sky = false;
  double white = 0.7;  ///< reflectance; rows of the form factors are closed where it is high
};

/// `whole_error`: asked for where the mesh follows the light.
inline SolveOptions optionsOf(const SolveCase& c, double whole_error) {
  SolveOptions options;
  options.form_factors = c.method;
  options.mode = c.mode;
  options.kept_bytes = c.kept_bytes;
  options.error = c.follows_light ? whole_error : 0.001;
  if (!c.follows_light) options.elements = 300;
  if (c.sky) options.sky = glm::dvec3(0.2, 0.3, 0.5);
  return options;
}

/// Returns how many steps it took.
inline int run(Solve& solve, int most_steps = 1'000'000) {
  int steps = 0;
  for (; solve.state() == SolveState::kRunning && steps < most_steps; ++steps) solve.step();
  return steps;
}

/// RMS of the difference over RMS of `b`.
inline double rmsDifference(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  double off = 0, all = 0;
  for (std::size_t v = 0; v < b.size(); ++v) {
    const glm::dvec3 d = glm::dvec3(a[v]) - glm::dvec3(b[v]);
    off += glm::dot(d, d);
    all += glm::dot(glm::dvec3(b[v]), glm::dvec3(b[v]));
  }
  return std::sqrt(off / all);
}

}  // namespace unshot::testing_support
