// Solutions as PLY: binary little-endian, one radiosity per display vertex.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "session/snapshot.h"

namespace unshot {

/// The bytes of a PLY file. Per vertex: x y z (file coordinates) nx ny nz radiosity_r radiosity_g radiosity_b
/// (float, linear, E included) and red green blue (8 bits: exposed by the factor `exposure`, tone-mapped,
/// sRGB); triangles, wound counter-clockwise as seen from the side they belong to. Vertices are doubled where
/// values jump.
std::string plyBytes(const Snapshot& snapshot, bool with_ambient, double exposure);

/// What compare needs of a PLY file.
struct PlySolution {
  std::vector<glm::dvec3> positions;  ///< file coordinates
  std::vector<glm::dvec3> radiosity;  ///< one per vertex
  /// Three vertices per triangle, counter-clockwise as seen from their side; empty where the file has none.
  std::vector<std::uint32_t> triangles;
};

/// Reads what plyBytes writes (any scalar vertex properties, in any order). Throws Error (kInput), Cancelled.
PlySolution readPly(const std::filesystem::path& path, const CancelToken& cancel = {});

}  // namespace unshot
