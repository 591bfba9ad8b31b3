// GLFW: its life in the process, windows and their OpenGL contexts.
#pragma once

#include <memory>
#include <string>

#include "gl/context.h"

struct GLFWwindow;

namespace unshot {

/// GLFW as long as it lives; at most one at a time, on the main thread. Throws Error kEnvironment where there
/// is no display.
class Glfw {
 public:
  Glfw();
  ~Glfw();
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;

  /// What GLFW last complained of, or empty.
  static std::string lastError();
};

/// The row of the viewer's window for a list of providers; it makes no context by itself.
gl::Provider glfwProvider();

/// A window with an OpenGL core context (3.3 or later), shown or hidden. Made and destroyed on the main
/// thread; a hidden one may be current on another thread.
class GlfwContext final : public gl::Context {
 public:
  /// By the display's own way (GLX), or EGL where that has none. Throws Error kEnvironment.
  static std::unique_ptr<GlfwContext> create(int width, int height, const std::string& title, bool visible);
  ~GlfwContext() override;

  GLFWwindow* window() const { return window_; }

 private:
  explicit GlfwContext(GLFWwindow* window);
  void bind() override;
  void unbind() override;

  GLFWwindow* window_;
};

}  // namespace unshot
