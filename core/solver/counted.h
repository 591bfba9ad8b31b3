// Where the error of reflected light is measured.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace unshot {

/// One for each entry of the two: on what emits nothing (the picture of a bare lamp must not look converged)
/// and reflects something; on all of them, where there is no such.
inline std::vector<char> whereErrorsCount(std::span<const glm::dvec3> emission,
                                          std::span<const glm::dvec3> reflectance) {
  std::vector<char> counts(emission.size());
  for (std::size_t q = 0; q < counts.size(); ++q)
    counts[q] = emission[q] == glm::dvec3(0.0) && reflectance[q] != glm::dvec3(0.0);
  if (std::find(counts.begin(), counts.end(), 1) == counts.end()) std::fill(counts.begin(), counts.end(), 1);
  return counts;
}

}  // namespace unshot
