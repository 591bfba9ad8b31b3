// The line scan of an MTL file: what obj_line_scan is to an OBJ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace unshot {

/// A material as the file states it; texts are for messages, empty where the statement is missing.
struct MtlEntry {
  std::string name;
  std::uint32_t line = 0;
  std::string diffuse_text;
  std::uint32_t diffuse_line = 0;
  bool diffuse_readable = true;
  std::string emission_text;
  std::uint32_t emission_line = 0;
  bool emission_readable = true;
  std::uint32_t texture_line = 0;      ///< of map_Kd, 0: none
  std::vector<std::string> read_past;  ///< keywords that would change the picture, each once
};

struct MtlScan {
  /// Only `newmtl`, `Kd r g b`, `Ke r g b` and `map_Kd ...`. A NaN has become a number below every other, an
  /// infinity overflows: what is outside the range is clamped by the caller.
  std::string plain;
  std::vector<MtlEntry> entries;
};

MtlScan scanMtl(std::string_view text);

/// The file that an MTL or OBJ in `folder` calls `name`: as it is, with backslashes as slashes, without
/// quotes, without a trailing comment. Empty where none of them exists.
std::filesystem::path findBeside(const std::filesystem::path& folder, std::string_view name);

}  // namespace unshot
