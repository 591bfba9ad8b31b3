#include "viewer/memory.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/parse.h"

namespace unshot {
namespace {

constexpr std::size_t kCameras = 100, kScenes = 30, kSettings = 100;

std::string keyOf(const std::filesystem::path& scene) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(scene, error);
  return (error ? scene : absolute).lexically_normal().string();
}

std::string textOf(const Camera& camera) {
  std::string text;
  for (const glm::dvec3& p : {camera.eye, camera.at, camera.up}) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%.17g,%.17g,%.17g,", p.x, p.y, p.z);
    text += numbers;
  }
  char angle[32];
  std::snprintf(angle, sizeof angle, "%.17g,", camera.fov_deg);
  return text + angle + (camera.orthographic ? "1" : "0");
}

/// Nothing for a text that is none, or a camera that sees nothing.
std::optional<Camera> cameraOf(const std::string& text) {
  std::vector<double> n;
  for (const std::string_view part : splitParts(text, ',')) {
    const std::optional<double> number = parseNumber(part);
    if (!number || !(std::abs(*number) < 1e300)) return std::nullopt;
    n.push_back(*number);
  }
  if (n.size() != 11) return std::nullopt;
  const Camera camera{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9], n[10] != 0};
  const bool sees = camera.eye != camera.at && camera.up != glm::dvec3(0.0) && n[9] >= 1 && n[9] <= 170;
  return sees ? std::optional(camera) : std::nullopt;
}

}  // namespace

std::vector<RememberedLines::Line> RememberedLines::read() const {
  std::vector<Line> lines;
  std::ifstream in(file_);
  std::string text;
  while (lines.size() < most_ && std::getline(in, text)) {
    const std::size_t tab = text.find('\t');
    if (tab != std::string::npos) lines.emplace_back(text.substr(tab + 1), text.substr(0, tab));
  }
  return lines;
}

std::optional<std::string> RememberedLines::find(const std::string& key) const {
  for (const auto& [name, value] : read()) {
    if (name == key) return value;
  }
  return std::nullopt;
}

void RememberedLines::put(const std::string& key, const std::optional<std::string>& value) const {
  // What no line holds, and what is not there, need not be written.
  if (key.find('\n') != std::string::npos || (value && value->find_first_of("\t\n") != std::string::npos))
    return;
  if (!value && !find(key)) return;
  std::string text = value ? *value + "\t" + key + "\n" : "";
  std::size_t count = value ? 1 : 0;
  for (const auto& [name, old] : read()) {
    if (name != key && count++ < most_) text += old + "\t" + name + "\n";
  }
  std::filesystem::create_directories(file_.parent_path());
  writeWholeFileSoon(file_, text);  // no window waits for a disk
}

Memory::Memory(std::filesystem::path folder)
    : folder_(std::move(folder)),
      cameras_(folder_ / "cameras", kCameras),
      scenes_(folder_ / "scenes", kScenes),
      settings_(folder_ / "settings", kSettings) {}

std::filesystem::path Memory::usualFolder() {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path path = value ? value : "";
    return path.is_absolute() ? path : std::filesystem::path();  // others are to be ignored
  };
  if (const auto state = folder("XDG_STATE_HOME"); !state.empty()) return state / "unshot";
  const auto home = folder("HOME");
  return home.empty() ? home : home / ".local" / "state" / "unshot";
}

void Memory::put(const RememberedLines& lines, const std::string& key,
                 const std::optional<std::string>& value) {
  if (!on()) return;
  std::string wrong;
  try {
    return lines.put(key, value);
  } catch (const Error& error) {
    wrong = error.fullText();
  } catch (const std::filesystem::filesystem_error& error) {
    wrong = error.what();
  }
  complaint_ = "cameras and settings are not remembered: " + wrong;
  std::cerr << "unshot: " << complaint_ << std::endl;
  folder_.clear();
}

std::optional<Camera> Memory::camera(const std::filesystem::path& scene) const {
  if (!on()) return std::nullopt;
  const std::optional<std::string> text = cameras_.find(keyOf(scene));
  return text ? cameraOf(*text) : std::nullopt;
}

void Memory::keepCamera(const std::filesystem::path& scene, const std::optional<Camera>& camera) {
  put(cameras_, keyOf(scene), camera ? std::optional(textOf(*camera)) : std::nullopt);
}

std::vector<std::filesystem::path> Memory::scenes() const {
  std::vector<std::filesystem::path> scenes;
  if (!on()) return scenes;
  for (const auto& [scene, value] : scenes_.read()) {
    std::error_code error;
    if (std::filesystem::is_regular_file(scene, error)) scenes.emplace_back(scene);
  }
  return scenes;
}

void Memory::noteScene(const std::filesystem::path& scene) { put(scenes_, keyOf(scene), ""); }

std::optional<std::string> Memory::setting(const std::string& key) const {
  return on() ? settings_.find(key) : std::nullopt;
}

void Memory::keepSetting(const std::string& key, const std::string& value) {
  if (setting(key) != value) put(settings_, key, value);
}

}  // namespace unshot
