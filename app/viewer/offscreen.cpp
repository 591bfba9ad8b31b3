#include "viewer/offscreen.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include "base/clock.h"

namespace unshot {
namespace {

/// Woken by the session, as a window is by an event.
class Bell {
 public:
  void ring() {
    {
      const std::scoped_lock lock(mutex_);
      rung_ = true;
    }
    condition_.notify_one();
  }
  void wait(double seconds) {
    std::unique_lock lock(mutex_);
    condition_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return rung_; });
    rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  bool rung_ = false;
};

}  // namespace

int runOffscreen(ViewerSetup setup, const std::string& provider, int width, int height) {
  const std::unique_ptr<gl::Context> solver = gl::createContext(provider);
  const std::unique_ptr<gl::Context> display = gl::createContext(provider);
  display->makeCurrent();
  Bell bell;
  setup.display = display.get();
  setup.session.gl = solver.get();
  setup.session.wake = [&bell] { bell.ring(); };
  setup.resize = [&](int w, int h) {
    width = w;
    height = h;
  };
  std::shared_ptr<void> watch;
  if (setup.watch_interrupts) watch = setup.watch_interrupts([&bell] { bell.ring(); });
  Viewer viewer(std::move(setup));
  // Frames go nowhere, but are drawn as in a window: a small target is enough, screenshots have their own.
  const gl::Texture texture(*display);
  const gl::Framebuffer framebuffer(*display);
  const gl::Functions& fn = display->functions();
  try {
    double last = wallSeconds();
    int target_width = 0, target_height = 0;
    while (!viewer.closing() && !viewer.scriptDone()) {
      viewer.update(wallSeconds());
      const double now = wallSeconds();
      if (viewer.nextFrame(now) <= now) {
        if (!viewer.prepare()) continue;
        if (target_width != width || target_height != height) {
          fn.BindTexture(GL_TEXTURE_2D, texture.id());
          fn.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
          fn.BindTexture(GL_TEXTURE_2D, 0);
          fn.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
          fn.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
          framebuffer.checkComplete("the viewer without a window");
          target_width = width;
          target_height = height;
        }
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
        io.DeltaTime = static_cast<float>(std::clamp(now - last, 1e-4, 0.1));
        last = now;
        if (viewer.draw(framebuffer.id(), width, height)) viewer.presented();
        continue;
      }
      bell.wait(std::clamp(std::min(viewer.nextFrame(now), viewer.nextUpdate()) - now, 0.0, 1.0));
    }
  } catch (...) {
    throw viewer.rescue(presentError());
  }
  viewer.finish();
  return viewer.exitCode();
}

}  // namespace unshot
