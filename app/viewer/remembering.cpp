// What the viewer has to do with files between runs and while it runs: it remembers the scene's camera and
// the panel's look, and reads a scene that has changed again.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/parse.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr double kKeepSeconds = 2;  // what has changed rests so long before it is written

struct Switch {
  const char* key;
  bool ViewerState::*value;
};

/// Sections that actions open and close; the others are in the storage of ImGui.
constexpr std::array<Switch, 3> kSwitches = {{{"notes", &ViewerState::notes},
                                              {"left-out", &ViewerState::left_out},
                                              {"materials", &ViewerState::materials}}};

}  // namespace

/// Places the camera that is remembered for a scene that came up, if there is one.
bool Viewer::recallCamera() {
  if (!frame_wanted_ || !camera_from_memory_ || !state_->snapshot || scene_.snapshot() != state_->snapshot)
    return false;
  camera_from_memory_ = false;
  std::optional<Camera> camera = memory_.camera(state_->facts->scene_path);
  if (!camera) return false;
  const glm::dvec3& origin = state_->snapshot->mesh->frame_origin;
  camera->eye -= origin;
  camera->at -= origin;
  placeCamera(*camera);
  found_camera_.reset();
  scene_.snapExposure();
  last_motion_ = last_frame_;
  input();
  return true;
}

/// One that was found by itself is found again; it suits the window's shape then.
void Viewer::rememberCamera(const SessionState& state) {
  if (!state.snapshot || !state.facts || state.facts->scene_path != framed_scene_ || scene_.framing()) return;
  std::optional<Camera> camera;
  if (navigator_.camera() != found_camera_) {
    camera = navigator_.camera();
    camera->eye += state.snapshot->mesh->frame_origin;
    camera->at += state.snapshot->mesh->frame_origin;
  }
  memory_.keepCamera(state.facts->scene_path, camera);
}

/// When the camera, at rest by then, is to be written, so that a crash does not cost it.
double Viewer::nextCameraKept() const {
  if (!memory_.on() || !sceneStands() || navigator_.moving() || navigator_.camera() == kept_camera_)
    return kNever;
  return last_motion_ + kKeepSeconds;
}

/// The same for the panel.
double Viewer::nextKeeping() const { return std::min(nextCameraKept(), panel_changed_at_ + kKeepSeconds); }

void Viewer::keepWhatRests(double now) {
  if (now >= nextCameraKept()) {
    rememberCamera(*state_);
    kept_camera_ = navigator_.camera();
  }
  if (PanelLook look = panelLook(); look != panel_seen_) {
    panel_seen_ = std::move(look);
    panel_changed_at_ = now;
  }
  if (now < panel_changed_at_ + kKeepSeconds) return;
  panel_changed_at_ = kNever;
  rememberPanel();
}

Viewer::PanelLook Viewer::panelLook() const {
  PanelLook look{relative_scale_, {}, sections_};
  for (const Switch& one : kSwitches) look.switches.push_back(ui_.*one.value);
  return look;
}

void Viewer::recallPanel() {
  ui_.hint = memory_.on() && script_.empty() && !memory_.setting("hint");
  const std::string text = memory_.setting("scale").value_or("");
  const std::optional<double> scale = parseNumber(text);
  if (scale && *scale >= 0.1 && *scale <= 10) relative_scale_ = *scale;
  for (const Switch& one : kSwitches) {
    if (const auto value = memory_.setting(one.key)) ui_.*one.value = *value == "on";
  }
  panel_seen_ = panelLook();
}

/// It stays until it was surely seen, and is not shown again.
void Viewer::followHint(double now) {
  constexpr double kHintSeconds = 12;
  if (!ui_.hint) return;
  if (hint_until_ == 0 && sceneStands()) hint_until_ = now + kHintSeconds;
  if (hint_until_ > 0 && now >= hint_until_) endHint();
}

void Viewer::endHint() {
  if (!std::exchange(ui_.hint, false)) return;
  memory_.keepSetting("hint", "seen");
  input();
}

void Viewer::rememberPanel() {
  if (!memory_.on()) return;
  char scale[32];
  std::snprintf(scale, sizeof scale, "%.4g", relative_scale_);
  memory_.keepSetting("scale", scale);
  for (const Switch& one : kSwitches) memory_.keepSetting(one.key, ui_.*one.value ? "on" : "off");
  if (!sections_restored_) return;  // there was no room for them
  std::string text;
  for (const auto& [id, open] : sections_)
    text += (text.empty() ? "" : " ") + std::to_string(id) + (open != 0 ? "+" : "-");
  memory_.keepSetting("sections", text);
}

void Viewer::followSections(ImGuiStorage& sections) {
  if (!memory_.on()) return;
  const bool first = !std::exchange(sections_restored_, true);
  if (first) {
    const std::string text = memory_.setting("sections").value_or("");
    for (const std::string_view word : splitParts(text, ' ')) {
      if (word.size() < 2) continue;
      const std::optional<double> id = parseNumber(word.substr(0, word.size() - 1));
      if (id && *id >= 0 && *id <= 0xffffffff)
        sections.SetInt(static_cast<ImGuiID>(*id), word.back() == '+' ? 1 : 0);
    }
  }
  sections_.clear();
  for (const ImGuiStorage::ImGuiStoragePair& pair : sections.Data)
    sections_.emplace_back(pair.key, pair.val_i);
  if (first) panel_seen_.sections = sections_;
}

void Viewer::searchActions(const std::string& text) { ui_.prompt.begin(PromptKind::kActions, text); }

void Viewer::browse(const std::filesystem::path& folder) {
  FileList& files = ui_.prompt.files;
  std::error_code error;
  const auto isFolder = [&](const std::filesystem::path& path) {
    return std::filesystem::is_directory(path, error);
  };
  const std::filesystem::path last = memory_.setting("folder").value_or("");
  if (!folder.empty()) {
    files.open(folder);
  } else if (!files.folder().empty()) {
    files.open(files.folder());  // it may hold others now
  } else if (!last.empty() && isFolder(last)) {
    files.open(last);
  } else {
    files.open(state_->facts ? state_->facts->scene_path.parent_path() : std::filesystem::path());
  }
  ui_.prompt.begin(PromptKind::kFiles, "");
}

void Viewer::reload() {
  const std::filesystem::path scene = state_->facts ? state_->facts->scene_path : watch_.scene();
  if (scene.empty())
    throw Error(ErrorKind::kUsage, "there is no scene to read again", {}, "open a scene first");
  keepScene();
  open(scene);
}

void Viewer::keepScene() {
  watch_.accept();
  input();
}

void Viewer::watchScene(bool on) {
  watching_ = on;
  watch_.stop();
  if (!on || !state_->facts) return;
  watch_.opening(state_->facts->scene_path);
  watch_.opened();
}

}  // namespace unshot
