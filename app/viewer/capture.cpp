// Screenshots: the window's content drawn once more, without hurry, into a framebuffer of its own.
#include <algorithm>
#include <cctype>

#include "base/atomic_file.h"
#include "export/image_files.h"
#include "viewer/panels/panels.h"
#include "viewer/viewer.h"

namespace unshot {
namespace {

constexpr int kSamplesAlongPixel = 3;
constexpr double kMostSamples = 3e7;  // 16 bytes each

// A framebuffer of 8 bits a channel that can be read back.
class Canvas {
 public:
  Canvas(gl::Context& context, int width, int height)
      : fn_(context.functions()), texture_(context), framebuffer_(context), height_(height) {
    fn_.BindTexture(GL_TEXTURE_2D, texture_.id());
    fn_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    fn_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fn_.BindTexture(GL_TEXTURE_2D, 0);
    fn_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
    framebuffer_.checkComplete("a screenshot");
  }

  GLuint framebuffer() const { return framebuffer_.id(); }

  /// The left `width` columns.
  Image8 read(int width) const {
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height_));
    fn_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn_.ReadPixels(0, 0, width, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    Image8 image{width, height_, {}};
    image.rgb.reserve(pixels.size() / 4 * 3);
    for (int y = height_ - 1; y >= 0; --y) {
      const std::uint8_t* row = &pixels[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
      for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x)
        image.rgb.insert(image.rgb.end(), row + 4 * x, row + 4 * x + 3);
    }
    return image;
  }

 private:
  const gl::Functions& fn_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
  int height_;
};

}  // namespace

/// unshot-SCENE-001 and the ending, in the working folder, the first number that is free.
std::filesystem::path Viewer::newFileName(const std::string& ending) const {
  std::string stem = "unshot";
  if (state_->facts) stem += "-" + state_->facts->scene_name;
  for (char& c : stem) {
    if (c == '/' || c == '\\' || std::iscntrl(static_cast<unsigned char>(c))) c = '_';
  }
  for (int number = 1;; ++number) {
    std::string digits = std::to_string(number);
    digits.insert(0, digits.size() < 3 ? 3 - digits.size() : 0, '0');
    const std::filesystem::path path = std::filesystem::absolute(stem + "-" + digits + ending);
    const bool taken =
        std::any_of(captures_.begin(), captures_.end(), [&](const Capture& c) { return c.path == path; });
    if (!taken && !std::filesystem::exists(path)) return path;
  }
}

void Viewer::screenshot(std::filesystem::path path, bool with_panels) {
  if (path.empty()) path = newFileName(".png");
  checkWritable(path);
  captures_.push_back({std::move(path), with_panels});
  notice_.clear();
  input();
}

/// The scene of a screenshot, before the panels are built that tell of it.
void Viewer::drawForCapture(int width, int height) {
  if (!sceneStands()) return;
  try {
    const StateGuard guard(setup_.display->functions());
    scene_.setSnapshots(state_->snapshot, rivalSnapshot());
    int samples = kSamplesAlongPixel;
    while (samples > 1 && 1.0 * width * height * samples * samples > kMostSamples) --samples;
    scene_.draw({navigator_.camera(), ui_.settings, scene_width_, height, samples}, -1,
                SceneDisplay::kAtOnce);
  } catch (const Error& error) {
    captures_.pop_front();  // it is not tried for ever
    fail(error);
  }
}

void Viewer::capture(const Capture& wanted, int width, int height, int scene_width) {
  try {
    const StateGuard guard(setup_.display->functions());
    const Canvas canvas(*setup_.display, width, height);
    paint(canvas.framebuffer(), width, height, scene_width, wanted.with_panels);
    writePng(wanted.path, canvas.read(wanted.with_panels ? width : scene_width));
    notice("written: " + wanted.path.string());
  } catch (const Error& error) {
    fail(error);
  }
}

}  // namespace unshot
