// What the viewer remembers from one run to the next: cameras of scenes, scenes opened, settings. Lines of
// text in three files of a folder of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/camera.h"

namespace unshot {

/// A file of lines "VALUE<tab>KEY", the newest first and no more than `most`. Each change reads what is
/// there, so that several viewers may share it, and writes the whole file.
class RememberedLines {
 public:
  RememberedLines(std::filesystem::path file, std::size_t most) : file_(std::move(file)), most_(most) {}

  using Line = std::pair<std::string, std::string>;  // key, value
  /// What cannot be read is nothing.
  std::vector<Line> read() const;
  std::optional<std::string> find(const std::string& key) const;
  /// In front of all others; no value: forgets it. Throws Error where the file cannot be written.
  void put(const std::string& key, const std::optional<std::string>& value) const;

 private:
  std::filesystem::path file_;
  std::size_t most_;
};

/// What cannot be written is said once on the terminal and by takeComplaint(), and then nothing more is
/// remembered.
class Memory {
 public:
  /// In this folder, which is made when there is something to keep; empty: remembers nothing.
  explicit Memory(std::filesystem::path folder);

  /// $XDG_STATE_HOME/unshot, else ~/.local/state/unshot; empty where there is neither.
  static std::filesystem::path usualFolder();

  bool on() const { return !folder_.empty(); }
  /// Why nothing more is remembered, for the window, once; empty: nothing to say.
  std::string takeComplaint() { return std::exchange(complaint_, {}); }

  /// In the coordinates of the scene's file; kept for the hundred scenes looked at last.
  std::optional<Camera> camera(const std::filesystem::path& scene) const;
  void keepCamera(const std::filesystem::path& scene, const std::optional<Camera>& camera);

  /// The newest first, those that are still there.
  std::vector<std::filesystem::path> scenes() const;
  void noteScene(const std::filesystem::path& scene);

  std::optional<std::string> setting(const std::string& key) const;
  void keepSetting(const std::string& key, const std::string& value);

 private:
  void put(const RememberedLines& lines, const std::string& key, const std::optional<std::string>& value);

  std::filesystem::path folder_;
  std::string complaint_;
  RememberedLines cameras_, scenes_, settings_;
};

}  // namespace unshot
