#include "viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <span>
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

/// A key, or a letter that it types, as the window system sent it.
struct KeyEvent {
  int key = GLFW_KEY_UNKNOWN, scancode = 0, action = GLFW_RELEASE, mods = 0;
  unsigned letter = 0;  // one that is typed, 0: a key
};

/// What is typed, in its order, to the frames that it is for. After a key that opens or ends a line of text
/// the others wait until the frames know who has the keyboard, however slow they are.
class Keys {
 public:
  Keys(Viewer& viewer, GLFWwindow* window) : viewer_(viewer), window_(window) {}

  void add(const KeyEvent& event) {
    events_.push_back(event);
    viewer_.input();
  }
  void beforeFrame() {
    if (waits_ > 0) --waits_;
    while (waits_ == 0 && !events_.empty()) {
      const KeyEvent event = events_.front();
      events_.pop_front();
      if (event.letter == 0) {
        press(event);
      } else {
        ImGui_ImplGlfw_CharCallback(window_, event.letter);
      }
    }
    for (const int key : pressed_) ImGui::GetIO().KeysDown[key] = true;
  }
  void afterFrame() {
    for (const int key : pressed_) ImGui::GetIO().KeysDown[key] = glfwGetKey(window_, key) == GLFW_PRESS;
    pressed_.clear();
    if (!events_.empty()) viewer_.input();
  }

 private:
  static constexpr int kFramesToSettle = 3;  // ImGui gives the keyboard to a line in its second frame

  void press(const KeyEvent& event) {
    ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.mods);
    if (event.action != GLFW_PRESS) return;
    // ImGui looks at keys once a frame, and would miss one that is up again by then.
    if (event.key >= 0 && event.key < IM_ARRAYSIZE(ImGuiIO::KeysDown)) pressed_.push_back(event.key);
    if (ImGui::GetIO().WantTextInput) {
      const bool ends =
          event.key == GLFW_KEY_ENTER || event.key == GLFW_KEY_KP_ENTER || event.key == GLFW_KEY_ESCAPE;
      if (ends) waits_ = kFramesToSettle;
      return;
    }
    constexpr int kOfTheDesktop = GLFW_MOD_ALT | GLFW_MOD_SUPER;
    if ((event.mods & kOfTheDesktop) != 0) return;
    // On most keyboards + is Shift and another key, so only Ctrl tells shortcuts apart.
    const bool ctrl = (event.mods & GLFW_MOD_CONTROL) != 0;
    const bool typing = viewer_.ui().prompt.open();
    viewer_.key(keyOfActions(event.key, glfwGetKeyName(event.key, event.scancode), ctrl), ctrl);
    if (viewer_.ui().prompt.open() == typing) return;
    waits_ = kFramesToSettle;
    // The letter of the key that opens the line is not for it.
    if (!events_.empty() && events_.front().letter != 0) events_.pop_front();
  }

  Viewer& viewer_;
  GLFWwindow* window_;
  std::deque<KeyEvent> events_;
  std::vector<int> pressed_;  // since the last frame
  int waits_ = 0;             // frames
};

/// What the window's callbacks are for.
struct Receiver {
  Viewer& viewer;
  Keys keys;
};

Receiver& receiverOf(GLFWwindow* window) { return *static_cast<Receiver*>(glfwGetWindowUserPointer(window)); }

Viewer& viewerOf(GLFWwindow* window) { return receiverOf(window).viewer; }

void setCallbacks(GLFWwindow* window) {
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
/// calls; keys come to it by way of Keys.
struct GuiInput {
  explicit GuiInput(GLFWwindow* window) {
    ImGui_ImplGlfw_InitForOther(window, true);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
      receiverOf(w).keys.add({key, scancode, action, mods});
    });
    glfwSetCharCallback(window,
                        [](GLFWwindow* w, unsigned letter) { receiverOf(w).keys.add({.letter = letter}); });
  }
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

/// The monitor that most of the window is on.
GLFWmonitor* monitorOf(GLFWwindow* window) {
  int x = 0, y = 0, width = 0, height = 0, count = 0;
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  GLFWmonitor** const monitors = glfwGetMonitors(&count);
  GLFWmonitor* best = count > 0 ? monitors[0] : nullptr;
  long most = 0;
  for (GLFWmonitor* const monitor : std::span(monitors, static_cast<std::size_t>(count))) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitor, &left, &top);
    const GLFWvidmode* const mode = glfwGetVideoMode(monitor);
    const long across = std::min(x + width, left + mode->width) - std::max(x, left),
               down = std::min(y + height, top + mode->height) - std::max(y, top);
    if (across <= 0 || down <= 0 || across * down <= most) continue;
    most = across * down;
    best = monitor;
  }
  return best;
}

/// Fills the screen with the window, and remembers where it was before.
class FullScreen {
 public:
  explicit FullScreen(GLFWwindow* window) : window_(window) {}

  void set(std::optional<bool> wanted) {
    const bool on = glfwGetWindowMonitor(window_) != nullptr;
    if (wanted.value_or(!on) == on) return;
    if (on) {
      glfwSetWindowMonitor(window_, nullptr, x_, y_, width_, height_, GLFW_DONT_CARE);
      return;
    }
    GLFWmonitor* const monitor = monitorOf(window_);
    if (!monitor) return;
    glfwGetWindowPos(window_, &x_, &y_);
    glfwGetWindowSize(window_, &width_, &height_);
    const GLFWvidmode* const mode = glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }

 private:
  GLFWwindow* window_;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;
};

/// The size of a first window on a screen with a larger scale, where the window system counts in pixels.
void fitToScale(GLFWwindow* window, const WindowOptions& options, double scale) {
  int units = 0, pixels = 0;
  glfwGetWindowSize(window, &units, nullptr);
  glfwGetFramebufferSize(window, &pixels, nullptr);
  if (options.size_given || scale <= 1 || units != pixels) return;
  WindowOptions larger{static_cast<int>(std::lround(scale * options.width)),
                       static_cast<int>(std::lround(scale * options.height)), false};
  fitToScreen(larger);
  glfwSetWindowSize(window, larger.width, larger.height);
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
    receiver.keys.beforeFrame();
    ImGui_ImplGlfw_NewFrame();
    const bool changed = viewer.draw(0, width, height);
    receiver.keys.afterFrame();
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
    FullScreen full_screen(window);
    setup.full_screen = [&](std::optional<bool> on) { full_screen.set(on); };
    setup.key_name = [](int key) { return glfwGetKeyName(key, 0); };
    setup.title = [window](const std::string& title) { glfwSetWindowTitle(window, title.c_str()); };
    std::shared_ptr<void> watch;
    if (setup.watch_interrupts) watch = setup.watch_interrupts([] { glfwPostEmptyEvent(); });
    int code = 0;
    {
      Viewer viewer(std::move(setup));
      Receiver receiver{viewer, {viewer, window}};
      glfwSetWindowUserPointer(window, &receiver);
      setCallbacks(window);
      const GuiInput input(window);
      float scale = 1;
      glfwGetWindowContentScale(window, &scale, nullptr);
      viewer.setScreenScale(scale);
      fitToScale(window, options, scale);
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
