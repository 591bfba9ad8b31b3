// What a folder holds, for choosing a file: folders and what the viewer takes, and what of them goes with a
// text.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace unshot {

/// `text` without capital letters (ASCII).
std::string lowered(std::string_view text);

class FileList {
 public:
  struct Entry {
    std::string name;  ///< "..": the folder above
    bool folder = false;
  };

  /// The folder as it is now. Throws Error (kInput) where it cannot be read, and stays where it was.
  void open(const std::filesystem::path& folder);
  const std::filesystem::path& folder() const { return folder_; }
  /// The folder above, folders, scenes, then other files that an action takes (file_kinds.h), each by name;
  /// hidden ones are left out.
  const std::vector<Entry>& entries() const { return entries_; }

  /// Follows a typed path: into the folder that stands before the last slash, where there is one. Returns
  /// what is left of the text.
  std::string follow(const std::string& text);
  /// Those that have the text in their name; those that begin with it first.
  std::vector<Entry> matching(std::string_view text) const;
  /// The text with as much more as all entries that begin with it have in common; a folder with its slash.
  std::string completed(const std::string& text) const;
  std::filesystem::path pathOf(const Entry& entry) const;

 private:
  std::filesystem::path folder_;
  std::vector<Entry> entries_;
};

}  // namespace unshot
