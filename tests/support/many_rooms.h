// Closed rooms side by side, each with a finely tessellated thing in it, of which the first alone has a lamp.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "scene/analytic_scenes.h"

namespace unshot::testing_support {

/// A polyhedron about `middle` with bumps, of some 4 rings^2 triangles none of which lie in one plane.
inline void addBumpyBall(SceneBuilder& builder, std::uint32_t material, const glm::dvec3& middle, int rings) {
  const auto at = [&](int ring, int step) {
    const double polar = std::numbers::pi * ring / rings,
                 around = std::numbers::pi * (step % (2 * rings)) / rings;
    const double radius = 0.8 + 0.1 * std::sin(3 * polar) * std::cos(5 * around);
    return middle + radius * glm::dvec3(std::sin(polar) * std::cos(around), std::cos(polar),
                                        std::sin(polar) * std::sin(around));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int step = 0; step < 2 * rings; ++step) {
      const glm::dvec3 a = at(ring, step), b = at(ring + 1, step), c = at(ring + 1, step + 1),
                       d = at(ring, step + 1);
      if (ring > 0) builder.polygon(material, {a, d, b});
      if (ring + 1 < rings) builder.polygon(material, {b, d, c});
    }
  }
}

/// Corner of room k.
inline glm::dvec3 cornerOfRoom(int k) { return {5.0 * (k % 4), 0, 5.0 * (k / 4)}; }

/// Rooms of 4 x 3 x 4; `rings`: of the ball in the first, which has the lamp, and in all others.
inline Scene manyRooms(int rooms, int rings, int rings_of_others) {
  SceneBuilder builder;
  const auto grey = builder.material("grey", glm::dvec3(0.5, 0.6, 0.7));
  const auto lamp = builder.material("lamp", glm::dvec3(0.3), glm::dvec3(10));
  for (int k = 0; k < rooms; ++k) {
    addBox(builder, allOf(grey), cornerOfRoom(k), {4, 3, 4}, true);
    addBumpyBall(builder, grey, cornerOfRoom(k) + glm::dvec3(2, 1.2, 2), k == 0 ? rings : rings_of_others);
  }
  builder.quad(lamp, {1.5, 2.8, 1.5}, {1, 0, 0}, {0, 0, 1});
  return builder.finish();
}

}  // namespace unshot::testing_support
