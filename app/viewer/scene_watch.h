// Notices that a scene's files, its OBJ and the MTLs it names, have changed since they were read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "viewer/background.h"

namespace unshot {

/// The files that an OBJ names after mtllib, with what else its words may name; itself first. Throws
/// Cancelled.
std::vector<std::filesystem::path> sceneFiles(const std::filesystem::path& scene,
                                              const CancelToken& cancel = {});

/// Times are wallSeconds().
class SceneWatch {
 public:
  /// The scene is about to be read: from now on its files are others if they change.
  void opening(const std::filesystem::path& scene);
  /// It was read, or could not be read: it takes the place of the one watched before.
  void opened();
  void stop();

  /// The scene that is watched, and that which is about to be; empty: none.
  const std::filesystem::path& scene() const { return watched_.scene; }
  const std::filesystem::path& sceneOpening() const { return opening_.scene; }

  /// Looks at the files where it is time to. Returns whether changed() is another than before.
  bool look(double now);
  double nextLook() const { return watched_.scene.empty() ? std::numeric_limits<double>::infinity() : next_; }
  /// Whether it is known what the files were.
  bool stands() const { return watched_.stamps.has_value(); }
  /// Whether the files are others and have stood still for half a second, so that nobody is writing them.
  bool changed() const { return changed_; }
  /// What they are now is as good as what was read.
  void accept();

 private:
  struct Stamp {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time{};
    bool there = false;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::vector<std::pair<std::filesystem::path, Stamp>>;
  struct Watched {
    std::filesystem::path scene;
    std::unique_ptr<Background<Stamps>> reading;  // of a large file takes its time
    std::optional<Stamps> stamps;
  };
  static Stamp stampOf(const std::filesystem::path& file);
  static Stamps stampsOf(const std::filesystem::path& scene, const Stamp& own, const CancelToken& cancel);

  Watched watched_, opening_;
  Stamps seen_;  // at the last look
  bool changed_ = false;
  double next_ = 0;
};

}  // namespace unshot
