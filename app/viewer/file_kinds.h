// What the viewer does with files, by the endings of their names: the same for what is dropped on the window,
// chosen from a list, or typed.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace unshot {

struct FileKind {
  std::string_view ending;        ///< without capital letters, with its dot
  std::string_view what;          ///< "a picture"
  std::string_view action;        ///< takes the path of such a file; empty: none does
  std::string_view instead = {};  ///< then: what to do with it
};
std::span<const FileKind> fileKinds();

/// Null for an ending that is not known.
const FileKind* kindOfFile(const std::filesystem::path& file);
/// Whether an action takes it.
bool isTaken(const std::filesystem::path& file);
bool isScene(const std::filesystem::path& file);

}  // namespace unshot
