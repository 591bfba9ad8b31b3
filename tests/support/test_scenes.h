// Scenes that several tests ask for.
#pragma once

#include <cmath>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <utility>
#include <vector>

#include "scene/analytic_scenes.h"
#include "scene/obj_reader.h"

namespace unshot::testing_support {

inline Scene publishedCornellBox() {
  return readObj(std::filesystem::path(UNSHOT_TEST_DATA) / "cornell_published.obj");
}

/// The same scene elsewhere: position = scale * turn * position + shift. `order`: its polygons in this order
/// (empty: as they are).
inline Scene moved(const Scene& scene, const glm::dmat3& turn, double scale = 1,
                   const glm::dvec3& shift = glm::dvec3(0.0), const std::vector<std::uint32_t>& order = {}) {
  SceneBuilder builder;
  for (const Material& m : scene.materials) builder.material(m.name, m.reflectance, m.emission);
  for (std::size_t k = 0; k < scene.polygons.size(); ++k) {
    const Polygon& polygon = scene.polygons[order.empty() ? k : order[k]];
    std::vector<glm::dvec3> corners;
    for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
      corners.push_back(scale * (turn * (scene.frame_origin + scene.position(polygon, c))) + shift);
    }
    builder.polygon(polygon.material, corners);
  }
  return builder.finish();
}

inline glm::dmat3 unturned() { return glm::dmat3(1.0); }

/// A point of the floor y = 0.
inline glm::dvec3 onFloor(double x, double z) { return {x, 0, z}; }

/// A floor [0, 4] x [0, 4] without walls, its front up, on it a block without a bottom, turned by `angle`
/// about its middle (2, 2): half extents 0.7 along and 0.45 across, 1 high.
inline std::vector<glm::dvec3> blockFootprint(double angle) {
  const glm::dvec3 along(std::cos(angle), 0, std::sin(angle)), across(-std::sin(angle), 0, std::cos(angle));
  const glm::dvec3 middle = onFloor(2, 2);
  return {middle - 0.7 * along - 0.45 * across, middle + 0.7 * along - 0.45 * across,
          middle + 0.7 * along + 0.45 * across, middle - 0.7 * along + 0.45 * across};
}

inline Scene blockOnFloor(double angle) {
  SceneBuilder b;
  const auto floor = b.material("floor", glm::dvec3(0.5)), block = b.material("block", glm::dvec3(0.5));
  const auto light = b.material("light", glm::dvec3(0.0), glm::dvec3(1.0));
  b.quad(floor, onFloor(0, 0), onFloor(0, 4), onFloor(4, 0));
  const std::vector<glm::dvec3> foot = blockFootprint(angle);
  const glm::dvec3 up(0, 1, 0);
  for (std::size_t k = 0; k < 4; ++k) b.quad(block, foot[k], up, foot[(k + 1) % 4] - foot[k]);
  b.polygon(block, {foot[3] + up, foot[2] + up, foot[1] + up, foot[0] + up});
  b.quad(light, {1, 3, 1}, {2, 0, 0}, {0, 0, 2});
  return b.finish();
}

/// A closed room over an L: [0, 2] x [0, 1] and [0, 1] x [0, 2], 1 high; floor and ceiling are concave.
inline Scene lShapedRoom() {
  SceneBuilder b;
  const auto white = b.material("white", glm::dvec3(0.5), glm::dvec3(0.5));
  const std::vector<glm::dvec3> ring{onFloor(0, 0), onFloor(2, 0), onFloor(2, 1),
                                     onFloor(1, 1), onFloor(1, 2), onFloor(0, 2)};
  const glm::dvec3 up(0, 1, 0);
  std::vector<glm::dvec3> floor(ring.rbegin(), ring.rend()), ceiling;
  for (const glm::dvec3& p : ring) ceiling.push_back(p + up);
  b.polygon(white, floor);
  b.polygon(white, ceiling);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const glm::dvec3 a = ring[k], c = ring[(k + 1) % ring.size()];
    b.quad(white, a, c - a, up);
  }
  return b.finish();
}

}  // namespace unshot::testing_support
