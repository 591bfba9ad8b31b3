// Probes: radiosity at given points, as displayed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/cancel.h"
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

/// Where on the mesh a probe lies: in a display triangle, or on a side that no light can reach.
struct ProbePlace {
  bool dark = false;
  std::uint32_t vertices[3] = {};  ///< in Mesh::vertices, unless dark
  glm::dvec3 weights{0.0};         ///< of their values; 0 where it is dark

  /// The value there of a field with one value `of(v)` a vertex.
  template <class F>
  glm::dvec3 value(F&& of) const {
    glm::dvec3 sum{0.0};
    for (int k = 0; k < 3; ++k) {
      if (!dark) sum += weights[k] * glm::dvec3(of(vertices[k]));
    }
    return sum;
  }
};

/// On the nearest surface side whose normal is within 60 degrees of the probe's; nothing for a probe farther
/// than 1/500 of the scene's diagonal from every such side. For few probes near each other it looks at each
/// display triangle once and builds nothing.
std::vector<std::optional<ProbePlace>> placeProbes(const Mesh& mesh, std::span<const Probe> probes);

/// B [W/m^2] (with E) at each probe: interpolated at its place. A side that no light can reach counts with
/// B = 0. Nothing for a probe that has no place.
std::vector<std::optional<glm::dvec3>> answerProbes(const Snapshot& snapshot, std::span<const Probe> probes,
                                                    bool with_ambient);

/// The same of a PLY solution. Throws Error (kInput) where it has no triangles, Cancelled.
std::vector<std::optional<glm::dvec3>> answerProbes(const PlySolution& solution,
                                                    std::span<const Probe> probes,
                                                    const CancelToken& cancel = {});

/// "x,y,z,nx,ny,nz,B_r,B_g,B_b" with a header, the same rows in the same order; the last three empty where
/// there is no answer.
std::string probeCsv(std::span<const Probe> probes, std::span<const std::optional<glm::dvec3>> answers);

}  // namespace unshot
