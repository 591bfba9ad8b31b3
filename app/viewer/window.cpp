#include "viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/clock.h"
#include "viewer/actions/actions.h"
#include "viewer/glfw_context.h"

namespace unshot {
namespace {

constexpr double kLongestWait = 3600;

std::string adviceWithoutWindow(const std::filesystem::path& scene) {
  return "without a window: unshot solve " + (scene.empty() ? std::string("SCENE.obj") : scene.string()) +
         " --png picture.png";
}

/// Keys that went down since the last frame. ImGui looks at keys once a frame, and would miss one that is up
/// again by then.
class PressedKeys {
 public:
  void note(int key) {
    if (key >= 0 && key < IM_ARRAYSIZE(ImGuiIO::KeysDown)) keys_.push_back(key);
  }
  void beforeFrame() const {
    set([](int) { return true; });
  }
  void afterFrame(GLFWwindow* window) {
    set([&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; });
    keys_.clear();
  }

 private:
  template <class F>
  void set(F&& isDown) const {
    for (const int key : keys_) ImGui::GetIO().KeysDown[key] = isDown(key);
  }
  std::vector<int> keys_;
};

/// What the window's callbacks are for.
struct Receiver {
  Viewer& viewer;
  PressedKeys keys;
};

Receiver& receiverOf(GLFWwindow* window) { return *static_cast<Receiver*>(glfwGetWindowUserPointer(window)); }

Viewer& viewerOf(GLFWwindow* window) { return receiverOf(window).viewer; }

void setCallbacks(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    Viewer& viewer = viewerOf(w);
    viewer.input();
    if (action == GLFW_PRESS) receiverOf(w).keys.note(key);
    constexpr int kOfTheDesktop = GLFW_MOD_ALT | GLFW_MOD_SUPER;
    if (action != GLFW_PRESS || ImGui::GetIO().WantTextInput || (mods & kOfTheDesktop) != 0) return;
    // On most keyboards + is Shift and another key, so only Ctrl tells shortcuts apart.
    const bool ctrl = (mods & GLFW_MOD_CONTROL) != 0;
    viewer.key(keyOfActions(key, glfwGetKeyName(key, scancode), ctrl), ctrl);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { viewerOf(w).input(); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { viewerOf(w).input(); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { viewerOf(w).input(); });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { viewerOf(w).input(); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { viewerOf(w).damaged(); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { viewerOf(w).damaged(); });
  glfwSetWindowContentScaleCallback(window,
                                    [](GLFWwindow* w, float x, float) { viewerOf(w).setScreenScale(x); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    if (count <= 0) return;
    const std::filesystem::path file = chosenFile({paths, static_cast<std::size_t>(count)});
    viewerOf(w).perform(actionOfFile(file), file.string());
  });
}

/// ImGui's inputs from the window, for as long as it lives. Installed after setCallbacks, whose callbacks it
/// calls.
struct GuiInput {
  explicit GuiInput(GLFWwindow* window) { ImGui_ImplGlfw_InitForOther(window, true); }
  ~GuiInput() { ImGui_ImplGlfw_Shutdown(); }
  GuiInput(const GuiInput&) = delete;
  GuiInput& operator=(const GuiInput&) = delete;
};

/// The size of a first window: not larger than the screen has room for.
void fitToScreen(WindowOptions& options) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (!monitor || options.size_given) return;
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  if (width > 0) options.width = std::min(options.width, width);
  if (height > 0) options.height = std::min(options.height, height);
}

/// To a framebuffer of this size [px]; the window system may count in larger units.
void resize(GLFWwindow* window, int width, int height) {
  int units = 0, pixels = 0;
  glfwGetWindowSize(window, &units, nullptr);
  glfwGetFramebufferSize(window, &pixels, nullptr);
  const double unit = units > 0 && pixels > 0 ? static_cast<double>(units) / pixels : 1;
  glfwSetWindowSize(window, static_cast<int>(std::lround(unit * width)),
                    static_cast<int>(std::lround(unit * height)));
}

void runLoop(Receiver& receiver, GLFWwindow* window) {
  Viewer& viewer = receiver.viewer;
  while (!viewer.closing()) {
    double now = wallSeconds();
    viewer.update(now);
    const double next = std::min(viewer.nextFrame(now), viewer.nextUpdate());
    if (next > now) {
      glfwWaitEventsTimeout(std::min(next - now, kLongestWait));
    } else {
      glfwPollEvents();
    }
    if (glfwWindowShouldClose(window)) viewer.close();
    now = wallSeconds();
    viewer.update(now);
    if (viewer.closing()) return;
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    if (width <= 0 || height <= 0 || viewer.nextFrame(now) > now || !viewer.prepare()) continue;
    ImGui_ImplGlfw_NewFrame();
    receiver.keys.beforeFrame();
    const bool changed = viewer.draw(0, width, height);
    receiver.keys.afterFrame(window);
    if (!changed) continue;
    glfwSwapBuffers(window);
    viewer.presented();
  }
}

}  // namespace

int runWindow(ViewerSetup setup, const WindowOptions& wanted) {
  WindowOptions options = wanted;
  const std::filesystem::path scene = setup.scene;
  try {
    const Glfw glfw;
    fitToScreen(options);
    // The solver's context lives in a window of its own that is never shown.
    const std::unique_ptr<GlfwContext> solver = GlfwContext::create(16, 16, "solver", false);
    const std::unique_ptr<GlfwContext> display =
        GlfwContext::create(options.width, options.height, "Unshot", true);
    GLFWwindow* window = display->window();
    display->makeCurrent();
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(window, 240, 180, GLFW_DONT_CARE, GLFW_DONT_CARE);
    setup.display = display.get();
    setup.session.gl = solver.get();
    setup.session.wake = [] { glfwPostEmptyEvent(); };
    setup.resize = [window](int width, int height) { resize(window, width, height); };
    setup.key_name = [](int key) { return glfwGetKeyName(key, 0); };
    setup.title = [window](const std::string& title) { glfwSetWindowTitle(window, title.c_str()); };
    std::shared_ptr<void> watch;
    if (setup.watch_interrupts) watch = setup.watch_interrupts([] { glfwPostEmptyEvent(); });
    int code = 0;
    {
      Viewer viewer(std::move(setup));
      Receiver receiver{viewer, {}};
      glfwSetWindowUserPointer(window, &receiver);
      setCallbacks(window);
      const GuiInput input(window);
      float scale = 1;
      glfwGetWindowContentScale(window, &scale, nullptr);
      viewer.setScreenScale(scale);
      try {
        runLoop(receiver, window);
      } catch (...) {
        glfwHideWindow(window);
        throw viewer.rescue(presentError());
      }
      // The window goes at once; the solver may need a moment to end its step and to save.
      glfwHideWindow(window);
      viewer.finish();
      code = viewer.exitCode();
    }
    return code;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kEnvironment || !error.advice().empty()) throw;
    throw Error(error.kind(), error.what(), error.where(), adviceWithoutWindow(scene));
  }
}

}  // namespace unshot
