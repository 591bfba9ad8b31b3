#include "viewer/scene_watch.h"

#include <fstream>
#include <string>
#include <utility>

#include "base/parse.h"

namespace unshot {
namespace {

constexpr double kFileLookSeconds = 1;
constexpr double kStillSeconds = 0.5;

}  // namespace

std::vector<std::filesystem::path> sceneFiles(const std::filesystem::path& scene, const CancelToken& cancel) {
  std::vector<std::filesystem::path> files{scene};
  std::ifstream in(scene);
  constexpr std::string_view kKeyword = "mtllib";
  std::string raw;
  while (std::getline(in, raw)) {
    cancel.check();
    const std::string_view line = trimmed(raw);
    if (!line.starts_with(kKeyword) || line.size() == kKeyword.size()) continue;
    if (const char after = line[kKeyword.size()]; after != ' ' && after != '\t') continue;
    const std::string_view names = trimmed(line.substr(kKeyword.size()));
    // One name with blanks in it, or several names.
    files.push_back(scene.parent_path() / names);
    if (names.find(' ') == std::string_view::npos) continue;
    for (const std::string_view name : splitParts(names, ' ')) {
      if (!name.empty()) files.push_back(scene.parent_path() / name);
    }
  }
  return files;
}

SceneWatch::Stamp SceneWatch::stampOf(const std::filesystem::path& file) {
  Stamp stamp;
  std::error_code error;
  stamp.size = std::filesystem::file_size(file, error);
  if (error) return {};
  stamp.time = std::filesystem::last_write_time(file, error);
  stamp.there = !error;
  return stamp;
}

SceneWatch::Stamps SceneWatch::stampsOf(const std::filesystem::path& scene, const Stamp& own,
                                        const CancelToken& cancel) {
  Stamps stamps;
  for (const std::filesystem::path& file : sceneFiles(scene, cancel))
    stamps.emplace_back(file, stampOf(file));
  stamps.front().second = own;
  return stamps;
}

void SceneWatch::opening(const std::filesystem::path& scene) {
  const auto read = [scene, own = stampOf(scene)](const CancelToken& cancel) {
    return stampsOf(scene, own, cancel);
  };
  opening_ = {scene, std::make_unique<Background<Stamps>>(read, nullptr), {}};
}

void SceneWatch::opened() {
  if (opening_.scene.empty()) return;
  watched_ = std::exchange(opening_, {});
  seen_.clear();
  changed_ = false;
  next_ = 0;
}

void SceneWatch::stop() {
  watched_ = {};
  opening_ = {};
  changed_ = false;
}

bool SceneWatch::look(double now) {
  if (watched_.scene.empty() || now < next_) return false;
  next_ = now + kFileLookSeconds;
  if (!watched_.stamps) {
    if (!watched_.reading->ready()) return false;
    try {
      watched_.stamps = watched_.reading->take();
    } catch (...) {  // what cannot be read is not watched
      stop();
      return false;
    }
  }
  Stamps now_there = *watched_.stamps;
  for (auto& [file, stamp] : now_there) stamp = stampOf(file);
  const bool others = now_there != *watched_.stamps;
  const bool whole = now_there.front().second.there && now_there.front().second.size > 0;
  const bool still = now_there == seen_;
  if (others && !still) next_ = now + kStillSeconds;
  seen_ = std::move(now_there);
  const bool changed = others && still && whole;
  return std::exchange(changed_, changed) != changed;
}

void SceneWatch::accept() {
  if (!seen_.empty()) watched_.stamps = seen_;
  changed_ = false;
}

}  // namespace unshot
