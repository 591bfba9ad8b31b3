// A scene as plain values: polygons with materials, in the scene's own frame.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace unshot {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Diffuse material. Reflectance 0..1 per channel; emission E [W/m^2] per channel, the unit that B is shown
/// in.
struct Material {
  std::string name;
  glm::dvec3 reflectance{0.5};
  glm::dvec3 emission{0.0};

  bool emits() const { return emission.x > 0 || emission.y > 0 || emission.z > 0; }
  bool operator==(const Material&) const = default;
};

/// One corner of a polygon: a position and, where the file gives one, a shading normal (else kNone).
struct Corner {
  std::uint32_t position = 0;
  std::uint32_t normal = kNone;
};

/// A planar simple polygon (concave and collinear corners allowed; its corners run counter-clockwise seen
/// from its front). A face of the file that is not planar has become several polygons that share `face`.
struct Polygon {
  std::uint32_t first_corner = 0;
  std::uint32_t corner_count = 0;
  std::uint32_t material = 0;
  std::uint32_t smoothing_group = 0;  ///< 0: none given
  std::uint32_t face = 0;             ///< index of the face in the file, counted from 0
  std::uint32_t line = 0;             ///< line of the face in the file, counted from 1
};

/// The scene. Positions are relative to `frame_origin` (file position = frame_origin + position), so that a
/// scene far from the file's origin keeps its digits.
struct Scene {
  std::filesystem::path path;
  std::string name;
  glm::dvec3 frame_origin{0.0};
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  ///< unit length
  std::vector<Corner> corners;
  std::vector<Polygon> polygons;
  std::vector<Material> materials;
  std::size_t face_count = 0;      ///< faces in the file
  std::size_t triangle_count = 0;  ///< triangles that the polygons make
  bool smoothing_given = false;    ///< the file speaks of smoothing groups (`s`)
  /// sceneHash() of the scene as it was read, where its materials have been edited since.
  std::optional<std::uint64_t> hash_as_read;
  Diagnostics diagnostics;

  glm::dvec3 bounds_min{0.0};  ///< over corners in use, in the scene's frame
  glm::dvec3 bounds_max{0.0};

  const glm::dvec3& position(const Polygon& p, std::uint32_t k) const {
    return positions[corners[p.first_corner + k].position];
  }
};

}  // namespace unshot
