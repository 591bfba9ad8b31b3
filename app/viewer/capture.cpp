// The viewer's screenshots: what they are called, and their turn between its frames.
#include <algorithm>
#include <cctype>

#include "base/atomic_file.h"
#include "base/clock.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr int kSamplesAlongPixel = 3;

}  // namespace

/// unshot-SCENE-001 and the ending, in the folder (none: the working folder), the first number that is free.
std::filesystem::path Viewer::newFileName(const std::string& ending,
                                          const std::filesystem::path& folder) const {
  std::string stem = "unshot";
  if (state_->facts) stem += "-" + state_->facts->scene_name;
  for (char& c : stem) {
    if (c == '/' || c == '\\' || std::iscntrl(static_cast<unsigned char>(c))) c = '_';
  }
  for (int number = 1;; ++number) {
    std::string digits = std::to_string(number);
    digits.insert(0, digits.size() < 3 ? 3 - digits.size() : 0, '0');
    std::error_code error;
    const std::filesystem::path path =
        std::filesystem::absolute(folder / (stem + "-" + digits + ending), error);
    if (error) {
      throw Error(ErrorKind::kEnvironment, "the working folder is gone (" + error.message() + ")", {},
                  "the action with a path in another folder");
    }
    if (!screenshots_.promised(path) && !std::filesystem::exists(path, error)) return path;
  }
}

void Viewer::screenshot(std::filesystem::path path, bool with_panels) {
  if (path.empty()) path = newFileName(".png");
  checkWritable(path);
  screenshots_.ask(std::move(path), with_panels);
  followScreenshots(wallSeconds());
}

/// Ends one that is written, and begins the next.
void Viewer::followScreenshots(double now) {
  try {
    if (const auto path = screenshots_.written()) notice("written: " + path->string());
  } catch (const Cancelled&) {
  } catch (...) {
    fail(presentError());
  }
  if (!screenshots_.toBegin()) return;
  screenshots_.begin({navigator_.camera(), ui_.settings}, now);
  notice_.clear();
  input();
}

/// Whether the window shows what the first of them is to be of.
bool Viewer::screenshotStands() const {
  if (!screenshots_.posing() || !screenshots_.panelsStand()) return false;
  const SceneSplit split = splitScene(scene_width_, scene_.racing());
  const bool no_room = split.left <= 0 || (scene_.racing() && split.right <= 0) || scene_height_ <= 0;
  return !sceneStands() || no_room ||
         (screenshots_.lit() && !scene_.outdated(wanted()) && !scene_.waits(wanted()) && !scene_.gliding());
}

void Viewer::keepScreenshot(int width, int height) {
  try {
    if (sceneStands()) scene_.beginFiner(kSamplesAlongPixel);
    screenshots_.keep({width, height, scene_width_}, *ImGui::GetDrawData(),
                      {referencePicture() ? reference_picture_ : nullptr, referenceLook()});
  } catch (...) {
    failScreenshot(presentError());
  }
}

void Viewer::drawScreenshot(double deadline) {
  try {
    if (!scene_.continueFiner(deadline)) return;
    screenshots_.write(scene_);
    scene_.endFiner();
  } catch (...) {
    failScreenshot(presentError());
  }
  input();
}

void Viewer::failScreenshot(const Error& error) {
  screenshots_.giveUp();  // it is not tried for ever
  scene_.endFiner();
  fail(error);
}

}  // namespace unshot
