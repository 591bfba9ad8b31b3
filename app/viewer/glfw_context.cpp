#include "viewer/glfw_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "base/error.h"

namespace unshot {
namespace {

[[noreturn]] void fail(const std::string& what) {
  const std::string reason = Glfw::lastError();
  throw Error(ErrorKind::kEnvironment, what + (reason.empty() ? "" : ": " + reason));
}

GLFWwindow* createWindow(int width, int height, const std::string& title, bool visible, int api) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, api);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, visible ? GLFW_TRUE : GLFW_FALSE);
  return glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
}

}  // namespace

Glfw::Glfw() {
  if (glfwInit() != GLFW_TRUE) fail("no window can be opened here");
}

Glfw::~Glfw() { glfwTerminate(); }

std::string Glfw::lastError() {
  const char* text = nullptr;
  return glfwGetError(&text) != GLFW_NO_ERROR && text ? text : "";
}

gl::Provider glfwProvider() {
  return {{"glfw", "GLFW", "the window of unshot view; needs a display"},
          nullptr,
          []() -> std::string {
            try {
              const Glfw glfw;
              return {};
            } catch (const Error& error) {
              return error.what();
            }
          },
          ""};
}

std::unique_ptr<GlfwContext> GlfwContext::create(int width, int height, const std::string& title,
                                                 bool visible) {
  GLFWwindow* window = createWindow(width, height, title, visible, GLFW_NATIVE_CONTEXT_API);
  if (!window) {
    const std::string reason = Glfw::lastError();
    window = createWindow(width, height, title, visible, GLFW_EGL_CONTEXT_API);
    if (!window) {
      throw Error(ErrorKind::kEnvironment,
                  "this display gives no window with OpenGL 3.3: " + reason + "; " + Glfw::lastError());
    }
  }
  std::unique_ptr<GlfwContext> context(new GlfwContext(window));
  context->initialise("glfw",
                      [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
  return context;
}

GlfwContext::GlfwContext(GLFWwindow* window) : window_(window) {}

GlfwContext::~GlfwContext() {
  release();
  glfwDestroyWindow(window_);
}

void GlfwContext::bind() {
  glfwMakeContextCurrent(window_);
  if (glfwGetCurrentContext() != window_) fail("cannot make the window's context current");
}

void GlfwContext::unbind() { glfwMakeContextCurrent(nullptr); }

}  // namespace unshot
