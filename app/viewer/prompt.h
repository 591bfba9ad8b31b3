// A line to type in over the scene, with a list below it: of all actions, or of a folder's files.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "viewer/file_list.h"

namespace unshot {

enum class PromptKind { kClosed, kActions, kFiles };

struct Prompt {
  PromptKind kind = PromptKind::kClosed;
  std::array<char, 1024> text{};
  std::optional<std::string> replacement;  ///< of the text, in the next frame
  std::size_t chosen = 0;                  ///< row of the list
  bool follow_chosen = false;              ///< it is to be seen
  std::string wrong;                       ///< with what was entered last
  FileList files;

  bool open() const { return kind != PromptKind::kClosed; }
  void begin(PromptKind what, const std::string& with) {
    kind = what;
    text = {};
    replacement = with;
    chosen = 0;
    wrong.clear();
  }
  void close() { kind = PromptKind::kClosed; }
};

}  // namespace unshot
