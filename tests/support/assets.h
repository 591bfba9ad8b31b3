// The scenes that come with the program.
#pragma once

#include <filesystem>
#include <string>

#include "scene/obj_reader.h"

namespace unshot::testing_support {

inline std::filesystem::path asset(const std::string& name) {
  return std::filesystem::path(UNSHOT_SOURCE_DIR) / "assets" / name;
}

inline Scene assetScene(const std::string& name) { return readObj(asset(name)); }

inline const std::string kCornellBox = asset("cornell_box.obj").string(),
                         kTwoPatches = asset("two_patches.obj").string();

}  // namespace unshot::testing_support
