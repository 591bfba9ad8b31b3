// Two files as pairs of values to be compared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "export/ply.h"

namespace unshot {

struct ValuePairs {
  std::string points;            ///< what they are: "pixels", "vertices", "probes"
  std::vector<glm::dvec3> a, b;  ///< same size
  std::size_t left_out = 0;      ///< points of the files that are not compared
  std::string note;              ///< why, or how the values were taken; may be empty
  std::optional<std::pair<ImageF, ImageF>> pictures;
  std::optional<std::pair<PlySolution, PlySolution>> solutions;  ///< on the same mesh
};

/// Reads two files of one kind, or a PLY solution and a table of probes, at whose points the solution is
/// interpolated. Pictures (PNG, HDR): linear values of the same size. PLY: radiosity at the
/// same vertices. CSV of probes, or of reference values: B at the same points in the same order; where either
/// file has columns E_r, E_g, E_b, the light that points emit by themselves is kept out: only points with E =
/// 0 are compared, or B - E where every point emits. Throws Error (kInput).
ValuePairs readPairs(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace unshot
