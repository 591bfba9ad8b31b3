#include "viewer/file_kinds.h"

#include <algorithm>
#include <array>
#include <string>

#include "viewer/file_list.h"

namespace unshot {
namespace {

constexpr std::string_view kSceneEnding = ".obj";

}  // namespace

std::span<const FileKind> fileKinds() {
  static constexpr auto kKinds =
      std::to_array<FileKind>({{kSceneEnding, "a scene", "open"},
                               {".unshot", "a saved solve", "open"},
                               {".ply", "a solution to compare with", "reference"},
                               {".png", "a picture", "reference-picture"},
                               {".jpg", "a picture", "reference-picture"},
                               {".jpeg", "a picture", "reference-picture"},
                               {".hdr", "a picture", "reference-picture"},
                               {".pfm", "a picture", "reference-picture"},
                               {".mtl", "materials of a scene", "", "the OBJ file that names them"},
                               {".script", "a script", "", "to start the program with it"}});
  return kKinds;
}

const FileKind* kindOfFile(const std::filesystem::path& file) {
  const std::string ending = lowered(file.extension().string());
  const std::span<const FileKind> kinds = fileKinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const FileKind& kind) { return kind.ending == ending; });
  return found == kinds.end() ? nullptr : &*found;
}

bool isTaken(const std::filesystem::path& file) {
  const FileKind* const kind = kindOfFile(file);
  return kind && !kind->action.empty();
}

bool isScene(const std::filesystem::path& file) {
  const FileKind* const kind = kindOfFile(file);
  return kind && kind->ending == kSceneEnding;
}

}  // namespace unshot
