// The line scan beside tinyobjloader: checks an OBJ, remembers the line of every face, and hands over a plain
// text in which nothing is left that tinyobjloader would misread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/cancel.h"
#include "scene/obj_text.h"

namespace unshot {

/// A face as the file states it.
struct ObjFace {
  std::uint32_t corner_count = 0;
  std::uint32_t line = 0;
  std::uint32_t material_name = 0;  ///< in ObjScan::material_names; kNone before any usemtl
  std::uint32_t smoothing_group = 0;
};

/// A name in the file and the line that speaks of it first.
struct ObjName {
  std::string text;
  std::uint32_t line = 0;
};

struct ObjScan {
  /// Only `v x y z`, `vn x y z` and `f v v v` or `f v//n`; numbers are finite or overflow to infinity.
  std::string plain;
  std::vector<ObjFace> faces;
  std::vector<ObjName> material_names;  ///< of materials that some face has
  std::vector<ObjName> libraries;       ///< what follows each mtllib, uncut
  std::size_t vertex_count = 0;
  std::size_t normal_count = 0;
  std::size_t texture_count = 0;
  bool smoothing_given = false;
  Tally lost_texture;  ///< corners whose texture index leads nowhere
  Tally lines_and_points;
  Tally free_form;
  Tally unknown;
  std::string first_unknown;
};

/// Throws Error (kInput, with file:line) for a binary text, a text without OBJ statements or without faces, a
/// vertex without three numbers, an index that is 0, no number, beyond 2^31 - 1 or before the first vertex.
/// Positive indices beyond the last vertex are left to the caller: a face may stand before its vertices.
ObjScan scanObj(std::string_view text, const std::filesystem::path& path, const CancelToken& cancel = {});

}  // namespace unshot
