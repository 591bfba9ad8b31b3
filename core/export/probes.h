// Probes: radiosity at given points, as displayed.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export/ply.h"
#include "session/snapshot.h"

namespace unshot {

/// A point in the file's own coordinates and the direction that its surface side faces (of any length, as
/// given).
struct Probe {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};
};

/// Reads lines "x,y,z,nx,ny,nz"; # comments and a header are allowed, further columns are read past.
/// Throws Error (kInput, with file:line).
std::vector<Probe> readProbes(const std::filesystem::path& path);

/// B [W/m^2] (with E) at each probe: interpolated over the display triangles of the nearest surface side
/// whose normal is within 60 degrees of the probe's. A side that no light can reach counts with B = 0.
/// Nothing for a probe farther than 1/500 of the scene's diagonal from every such side.
std::vector<std::optional<glm::dvec3>> answerProbes(const Snapshot& snapshot, std::span<const Probe> probes,
                                                    bool with_ambient);

/// The same of a PLY solution. Throws Error (kInput) where it has no triangles.
std::vector<std::optional<glm::dvec3>> answerProbes(const PlySolution& solution,
                                                    std::span<const Probe> probes);

/// "x,y,z,nx,ny,nz,B_r,B_g,B_b" with a header, the same rows in the same order; the last three empty where
/// there is no answer.
std::string probeCsv(std::span<const Probe> probes, std::span<const std::optional<glm::dvec3>> answers);

}  // namespace unshot
