#include "viewer/scene_display.h"

#include <cmath>

#include "base/clock.h"

namespace unshot {
namespace {

constexpr double kGlideSeconds = 0.25;  // time constant of the exposure
constexpr double kArrivedStops = 0.01;
// A jump of the light by more than this (a new display mode, a door opened) is not worth a glide.
constexpr double kJumpStops = 6;

bool same(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.at == b.at && a.up == b.up && a.fov_deg == b.fov_deg;
}

bool same(const DisplaySettings& a, const DisplaySettings& b) {
  return a.view.display == b.view.display && a.view.exposure_ev == b.view.exposure_ev &&
         a.view.ambient == b.view.ambient && a.view.indirect == b.view.indirect &&
         a.exposure_locked == b.exposure_locked;
}

}  // namespace

SceneDisplay::SceneDisplay(gl::Context& context)
    : context_(context), view_(context), picture_(context), framebuffer_(context) {}

void SceneDisplay::setSnapshot(std::shared_ptr<const Snapshot> snapshot) {
  if (snapshot == snapshot_) return;
  snapshot_ = std::move(snapshot);
  drawn_.reset();
  if (snapshot_) view_.setSnapshot(*snapshot_);
}

void SceneDisplay::startFraming(double aspect) {
  framing_.reset();
  AutomaticCameraOptions options;
  options.aspect = aspect;
  if (snapshot_) framing_.emplace(context_, snapshot_, options);
}

std::optional<Camera> SceneDisplay::continueFraming(std::optional<double> seconds) {
  if (!framing_) return std::nullopt;
  const double end = wallSeconds() + seconds.value_or(0);
  while (framing_->step()) {
    if (seconds && wallSeconds() >= end) return std::nullopt;
  }
  const Camera found = framing_->best();
  framing_.reset();
  return found;
}

bool SceneDisplay::stale(const Camera& camera, const DisplaySettings& settings, int width, int height,
                         int samples) const {
  if (!drawn_ || gliding_) return true;
  return !same(drawn_->camera, camera) || !same(drawn_->settings, settings) || drawn_->width != width ||
         drawn_->height != height || drawn_->samples != samples;
}

void SceneDisplay::allocate(int width, int height) {
  if (width == width_ && height == height_) return;
  const gl::Functions& fn = context_.functions();
  const StateGuard guard(fn);
  fn.BindTexture(GL_TEXTURE_2D, picture_.id());
  fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  fn.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  fn.BindTexture(GL_TEXTURE_2D, 0);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture_.id(), 0);
  framebuffer_.checkComplete("the picture in the window");
  width_ = width;
  height_ = height;
}

double SceneDisplay::nextExposure(double metered, double seconds) {
  const double stops = std::log2(metered / exposure_);
  const bool arrive = snap_ || seconds < 0 || !std::isfinite(stops) || std::abs(stops) < kArrivedStops ||
                      std::abs(stops) > kJumpStops;
  snap_ = false;
  gliding_ = !arrive;
  return arrive ? metered : exposure_ * std::exp2(stops * (1 - std::exp(-seconds / kGlideSeconds)));
}

bool SceneDisplay::draw(const Camera& camera, const DisplaySettings& settings, int width, int height,
                        int samples, double seconds) {
  if (width <= 0 || height <= 0 || !stale(camera, settings, width, height, samples)) return false;
  allocate(width, height);
  const gl::Functions& fn = context_.functions();
  const StateGuard guard(fn);
  fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  ViewOptions view = settings.view;
  view.supersampling = samples;
  // Direct light alone keeps the exposure of the whole, so that the eye sees what is missing.
  const bool follow = !settings.exposure_locked && view.indirect;
  if (drawn_ && drawn_->settings.view.display != view.display) snap_ = true;
  gliding_ = false;
  if (!follow && !snap_) {
    view.automatic_exposure = exposure_;
    view_.draw(camera, view, {0, 0, width, height});
  } else {
    const double metered = view_.drawSamples(camera, view, width, height);
    exposure_ = nextExposure(metered, seconds);
    view_.showSamples(exposure_, view, {0, 0, width, height});
  }
  drawn_ = Drawn{camera, settings, width, height, samples};
  next_band_ = 0;
  return true;
}

bool SceneDisplay::sharpen(int samples) {
  if (!drawn_ || next_band_ >= kBands) return false;
  const int bottom = height_ * next_band_ / kBands, top = height_ * (next_band_ + 1) / kBands;
  ++next_band_;
  if (samples <= drawn_->samples || top == bottom) return true;
  const StateGuard guard(context_.functions());
  if (band_.width() != width_ * samples || band_.height() != (top - bottom) * samples) {
    band_ = LinearTarget();
    band_ = LinearTarget(context_, width_ * samples, (top - bottom) * samples);
  }
  ViewOptions view = drawn_->settings.view;
  view.supersampling = samples;
  band_.bind();
  const FrameWindow window{{0, static_cast<double>(bottom) / height_},
                           {1, static_cast<double>(top) / height_}};
  view_.drawLinear(drawn_->camera, static_cast<double>(width_) / height_, window, view);
  context_.functions().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  view_.resolve(band_, exposure_, view, {0, bottom, width_, top - bottom});
  return true;
}

void SceneDisplay::copyTo(int x, int y) const {
  if (width_ == 0) return;
  const gl::Functions& fn = context_.functions();
  GLint read = 0;
  fn.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
  fn.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  fn.BlitFramebuffer(0, 0, width_, height_, x, y, x + width_, y + height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  fn.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read));
}

}  // namespace unshot
