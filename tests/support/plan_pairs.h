// Solves with and without what the plan leaves out, and how far they are apart.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "export/probes.h"
#include "session/scene_plan.h"
#include "support/solving.h"

namespace unshot::testing_support {

/// As `unshot solve` without a method.
inline SolveOptions soonest(double error) {
  SolveOptions options;
  options.soonest = true;
  options.error = error;
  return options;
}

inline std::set<std::string> keysOf(const Solve& solve) {
  std::set<std::string> out;
  for (const PlanDecision& d : solve.plan()) out.insert(d.key);
  return out;
}

/// RMS of what the two show apart over RMS of what `with` reflects, at the middle of each of its elements.
/// A side that the other leaves out counts as 0.
inline double difference(const Solve& with, const Solve& without) {
  const Mesh& mesh = with.mesh();
  std::vector<Probe> probes;
  std::vector<double> area;
  std::vector<glm::dvec3> emission;
  for (std::uint32_t e = 0; e < mesh.element_count; ++e) {
    const Side& side = mesh.sides[mesh.element_side[e]];
    const Surface& surface = mesh.surfaces[side.surface];
    probes.push_back({mesh.shapes[surface.elements.first + e - side.first_element].centre + mesh.frame_origin,
                      side.normal});
    area.push_back(mesh.element_area[e]);
    emission.push_back(side.emission);
  }
  const auto a = answerProbes(with.snapshot(), probes, false),
             b = answerProbes(without.snapshot(), probes, false);
  double squares = 0, reflected = 0;
  for (std::size_t k = 0; k < probes.size(); ++k) {
    EXPECT_TRUE(a[k] && b[k]) << k;
    if (!a[k] || !b[k]) continue;
    const glm::dvec3 apart = *a[k] - *b[k], light = *a[k] - emission[k];
    squares += area[k] * glm::dot(apart, apart);
    reflected += area[k] * glm::dot(light, light);
  }
  return std::sqrt(squares / reflected);
}

/// Solved as asked for, and with this done all the same; the plan must take the decision in the first alone.
struct Pair {
  std::unique_ptr<Solve> without, with;  // without the work, and with it
};
inline Pair solvedBothWays(const std::function<Scene()>& make, SolveOptions options, std::string_view key) {
  Pair out;
  out.without = solved(make(), options);
  options.do_anyway = {std::string(key)};
  out.with = solved(make(), options);
  EXPECT_EQ(keysOf(*out.without).count(std::string(key)), 1u);
  EXPECT_EQ(keysOf(*out.with).count(std::string(key)), 0u);
  return out;
}

}  // namespace unshot::testing_support
