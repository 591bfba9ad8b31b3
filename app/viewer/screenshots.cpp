#include "viewer/screenshots.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/srgb.h"
#include "export/image_files.h"
#include "render/targets.h"

namespace unshot {
namespace {

constexpr int kFramesOfPanels = 3;     // a new window comes one late, and takes its size in the next
constexpr double kDrawingShare = 0.9;  // of the time that a screenshot takes

// A framebuffer of 8 bits a channel that can be read back.
class Canvas {
 public:
  Canvas(gl::Context& context, int width, int height)
      : fn_(context.functions()), texture_(context), framebuffer_(context), width_(width), height_(height) {
    fn_.BindTexture(GL_TEXTURE_2D, texture_.id());
    fn_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    fn_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    fn_.BindTexture(GL_TEXTURE_2D, 0);
    fn_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.id(), 0);
    framebuffer_.checkComplete("a screenshot");
  }

  GLuint framebuffer() const { return framebuffer_.id(); }
  /// Binds it, all of one colour.
  void clear(float level, float alpha) const {
    fn_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn_.Viewport(0, 0, width_, height_);
    fn_.ClearColor(level, level, level, alpha);
    fn_.Clear(GL_COLOR_BUFFER_BIT);
  }
  /// RGBA, lowest row first.
  std::vector<std::uint8_t> read() const {
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width_) *
                                     static_cast<std::size_t>(height_));
    fn_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    fn_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
  }

 private:
  const gl::Functions& fn_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
  int width_, height_;
};

/// The left `width` columns of the scene, with the panels over it where there are any.
Image8 composed(const Screenshots::Layout& layout, int width, const std::vector<std::uint8_t>& scene,
                const std::vector<std::uint8_t>& panels) {
  Image8 image{width, layout.height, {}};
  image.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(layout.height));
  const auto row = 4 * static_cast<std::size_t>(layout.width);
  for (auto y = static_cast<std::size_t>(layout.height); y-- > 0;) {
    for (std::size_t k = y * row; k < y * row + 4 * static_cast<std::size_t>(width); k += 4) {
      const unsigned through = panels.empty() ? 255 : 255u - panels[k + 3];
      for (std::size_t c = k; c < k + 3; ++c) {
        const unsigned over = panels.empty() ? 0 : panels[c];
        image.rgb.push_back(
            static_cast<std::uint8_t>(std::min(255u, over + (scene[c] * through + 127) / 255)));
      }
    }
  }
  return image;
}

}  // namespace

bool Screenshots::promised(const std::filesystem::path& path) const {
  return std::any_of(asked_.begin(), asked_.end(), [&](const Asked& asked) { return asked.path == path; });
}

void Screenshots::begin(Subject subject, double now) {
  shot_ = std::make_unique<Shot>();
  shot_->subject = std::move(subject);
  shot_->began = now;
  shot_->frames_left = kFramesOfPanels;
}

void Screenshots::noteFrame() { shot_->frames_left = std::max(shot_->frames_left - 1, 0); }

void Screenshots::keep(const Layout& layout, const ImDrawData& panels, Over over) {
  if (asked_.front().with_panels) {
    const StateGuard guard(context_.functions());
    const Canvas canvas(context_, layout.width, layout.height);
    canvas.clear(0, 0);
    gui_.draw(panels, layout.width, layout.height);
    shot_->panels = canvas.read();
  }
  shot_->layout = layout;
  shot_->over = std::move(over);
  shot_->stage = Stage::kDrawing;
}

void Screenshots::write(const SceneArea& scene) {
  const Layout& layout = shot_->layout;
  const StateGuard guard(context_.functions());
  const Canvas canvas(context_, layout.width, layout.height);
  canvas.clear(static_cast<float>(srgbFromLinear(kBackground)), 1);
  const auto copy = [&](int width) { scene.copyFinerTo(width); };
  copy(layout.scene_width);
  const Over over = std::exchange(shot_->over, {});
  if (over.picture)
    over.picture->draw(copy, canvas.framebuffer(), layout.scene_width, layout.height, over.look);
  const int width = asked_.front().with_panels ? layout.width : layout.scene_width;
  shot_->stage = Stage::kWriting;
  shot_->writing = std::make_unique<Background<bool>>(
      [path = path(), layout, width, pixels = canvas.read(),
       panels = std::move(shot_->panels)](const CancelToken& cancel) {
        writePng(path, composed(layout, width, pixels, panels), cancel);
        return true;
      },
      wake_);
}

void Screenshots::next() {
  shot_.reset();
  asked_.pop_front();
}

std::optional<std::filesystem::path> Screenshots::written() {
  if (!shot_ || !shot_->writing || !shot_->writing->ready()) return std::nullopt;
  const std::unique_ptr<Background<bool>> writing = std::move(shot_->writing);
  std::filesystem::path path = asked_.front().path;
  next();
  writing->take();
  return path;
}

void Screenshots::giveUp() {
  if (asked_.empty()) return;
  if (shot_ && shot_->writing) {
    shot_->writing->giveUp();
  } else {
    next();
  }
}

void Screenshots::drop() {
  const bool writes = shot_ && shot_->writing;
  if (!writes) shot_.reset();
  asked_.resize(writes ? 1 : 0);
}

std::optional<double> Screenshots::began() const {
  if (toBegin()) return std::numeric_limits<double>::infinity();
  const bool given_up = shot_ && shot_->writing && shot_->writing->givenUp();
  return shot_ && !given_up ? std::optional(shot_->began) : std::nullopt;
}

double Screenshots::done(const SceneArea& scene) const {
  if (!shot_ || posing()) return 0;
  if (drawing()) return kDrawingShare * scene.finerDone();
  return kDrawingShare + (1 - kDrawingShare) * shot_->writing->done().value_or(0);
}

}  // namespace unshot
