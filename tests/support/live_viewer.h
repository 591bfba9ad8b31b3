// The viewer on OSMesa inside the test: a host without a window whose state and inputs the test holds.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>

#include "base/clock.h"
#include "gl/objects.h"
#include "viewer/viewer.h"

namespace unshot::testing_support {

class LiveViewer {
 public:
  struct Options {
    std::filesystem::path scene = {};
    SolveOptions solve = {};
    std::string script = {};
    std::filesystem::path memory = {};
    KeptSolve kept = {};
    int width = 320, height = 240;
    /// Pixels per unit of the window system: sizes are in pixels all the same, and so is ImGui's place of the
    /// mouse, as tests set it.
    float pixels_per_unit = 1;
    /// false: nothing of a frame is drawn, where nobody looks at its pixels, which cost most.
    /// Pictures of what a camera or a patch sees (SidePictures) are drawn all the same.
    bool pixels = true;
  };

  explicit LiveViewer(const Options& options)
      : width_(options.width),
        height_(options.height),
        pixels_per_unit_(options.pixels_per_unit),
        solver_(gl::createContext("osmesa")),
        display_(gl::createContext("osmesa")) {
    display_->makeCurrent();
    objects_ = std::make_unique<Objects>(*display_);
    ViewerSetup setup;
    setup.display = display_.get();
    setup.session = {solver_.get(), [this] { ring(); }, options.kept};
    setup.scene = options.scene;
    setup.options = options.solve;
    setup.settings.view.display = "radiosity";
    setup.memory = options.memory;
    std::istringstream script(options.script);
    setup.script = parseScript(script, "script");
    setup.resize = [this](int width, int height) { resize(width, height); };
    setup.title = [this](const std::string& title) { title_ = title; };
    if (!options.pixels) drawNothing();
    viewer_ = std::make_unique<Viewer>(std::move(setup));
    resize(width_, height_);
  }

  Viewer& operator*() { return *viewer_; }
  Viewer* operator->() { return viewer_.get(); }
  const gl::Functions& fn() const { return display_->functions(); }
  /// Of the solver's context, for its thread.
  const gl::Functions& solverFunctions() const { return solver_->functions(); }
  const std::string& title() const { return title_; }
  /// How many frames were drawn that looked otherwise than the one before.
  int painted() const { return painted_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Takes what happened and does what is due: a slice of the picture or a frame. Returns whether it was a
  /// frame.
  bool pump() {
    viewer_->update(wallSeconds());
    const double now = wallSeconds();
    if (viewer_->nextFrame(now) > now || !viewer_->prepare()) return false;
    draw();
    return true;
  }
  /// Draws a frame to its end, due or not.
  void draw() {
    const double now = wallSeconds();
    ImGuiIO& io = ImGui::GetIO();
    const float unit = 1 / pixels_per_unit_;
    io.DisplaySize = {unit * static_cast<float>(width_), unit * static_cast<float>(height_)};
    io.DisplayFramebufferScale = {pixels_per_unit_, pixels_per_unit_};
    if (ImGui::IsMousePosValid(&io.MousePos)) io.MousePos = {unit * io.MousePos.x, unit * io.MousePos.y};
    io.DeltaTime = static_cast<float>(std::clamp(now - last_, 1e-4, 0.1));
    last_ = now;
    if (!viewer_->draw(objects_->framebuffer.id(), width_, height_)) return;
    fn().Finish();
    viewer_->presented();
    ++painted_;
  }
  /// Waits until the session has something new, or for `seconds`.
  void rest(double seconds) {
    std::unique_lock lock(mutex_);
    condition_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return rung_; });
    rung_ = false;
  }
  /// Runs until the condition holds, and returns whether it did in time.
  bool until(const std::function<bool()>& condition, double seconds = 120) {
    const double end = wallSeconds() + seconds;
    while (!condition()) {
      if (wallSeconds() > end) return false;
      if (!pump()) rest(std::clamp(viewer_->nextFrame(wallSeconds()) - wallSeconds(), 0.0, 0.05));
    }
    return true;
  }
  /// Performs an action, and waits for what it reads beside the window.
  void performAndWait(const std::string& action, const std::string& argument) {
    viewer_->perform(action, argument);
    until([&] { return viewer_->scriptDone(); });
  }
  bool untilPhase(SessionPhase phase) {
    return until([&] { return viewer_->state().phase == phase; });
  }

 private:
  struct Objects {
    explicit Objects(gl::Context& context) : picture(context), framebuffer(context) {}
    gl::Texture picture;
    gl::Framebuffer framebuffer;
  };

  void ring() {
    {
      const std::scoped_lock lock(mutex_);
      rung_ = true;
    }
    condition_.notify_one();
  }
  void drawNothing() {
    auto& fn = const_cast<gl::Functions&>(this->fn());
    fn.DrawElementsBaseVertex = [](GLenum, GLsizei, GLenum, const void*, GLint) {};
    fn.DrawArrays = [](GLenum, GLint, GLsizei) {};
    fn.Clear = [](GLbitfield) {};
    fn.BlitFramebuffer = [](GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum) {};
  }
  void resize(int width, int height) {
    width_ = width;
    height_ = height;
    fn().BindTexture(GL_TEXTURE_2D, objects_->picture.id());
    fn().TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    fn().BindTexture(GL_TEXTURE_2D, 0);
    fn().BindFramebuffer(GL_FRAMEBUFFER, objects_->framebuffer.id());
    fn().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, objects_->picture.id(), 0);
    objects_->framebuffer.checkComplete("the test's window");
  }

  std::mutex mutex_;
  std::condition_variable condition_;
  bool rung_ = false;
  int width_, height_;
  float pixels_per_unit_;
  int painted_ = 0;
  double last_ = 0;
  std::string title_;
  std::unique_ptr<gl::Context> solver_, display_;
  std::unique_ptr<Objects> objects_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace unshot::testing_support
