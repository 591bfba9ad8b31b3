// A screen of the test's own (Xvfb), and what a person does at it (xdotool).
#pragma once

#include <X11/Xlib.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "support/run_program.h"

namespace unshot::testing_support {

/// Generous: machines that run other things too, with sanitizers.
constexpr double kPatience = 60;  // [s]

/// Asks again and again until the condition holds; returns whether it did in time.
inline bool eventually(const std::function<bool()>& condition, double seconds = kPatience) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (Clock::now() > end) return false;
    std::this_thread::yield();
    ::poll(nullptr, 0, 5);
  }
  return true;
}

/// An X server without a screen, on a display that was free. Sets DISPLAY for this process.
class Screen {
 public:
  explicit Screen(const std::vector<std::string>& further = {}) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::vector<std::string> words{"Xvfb",      "-displayfd", std::to_string(ends[1]),
                                   "-screen",   "0",          "1280x1060x24",
                                   "-nolisten", "tcp",        "-noreset"};
    words.insert(words.end(), further.begin(), further.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      const int quiet = ::open("/dev/null", O_WRONLY);
      ::dup2(quiet, STDOUT_FILENO);
      ::dup2(quiet, STDERR_FILENO);
      ::close(ends[0]);
      ::execvp(argv[0], argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    const std::string number = readLine(ends[0]);
    ::close(ends[0]);
    if (number.empty()) throw std::runtime_error("Xvfb does not start; it is in tests/packages");
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
  }
  ~Screen() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
    ::unsetenv("DISPLAY");
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

 private:
  static std::string readLine(int descriptor) {
    std::string line;
    char c = 0;
    pollfd wait{descriptor, POLLIN, 0};
    while (::poll(&wait, 1, static_cast<int>(1000 * kPatience)) > 0 && ::read(descriptor, &c, 1) == 1) {
      if (c == '\n') return line;
      line += c;
    }
    return "";
  }

  pid_t pid_ = -1;
};

/// What `xdotool ARGUMENTS` prints, without the end of the line; it waits for ever where the pointer cannot
/// move.
inline std::string xdotool(const std::string& arguments) {
  std::string output;
  FILE* pipe = ::popen(("timeout 30 xdotool " + arguments + " 2>/dev/null").c_str(), "r");
  if (!pipe) return "";
  char buffer[256];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, n);
  ::pclose(pipe);
  while (!output.empty() && output.back() == '\n') output.pop_back();
  return output;
}

/// What a window manager sends where a window's cross is clicked.
inline void askToClose(const std::string& window) {
  Display* display = ::XOpenDisplay(nullptr);
  ASSERT_TRUE(display);
  XEvent event;
  std::memset(&event, 0, sizeof event);
  event.xclient.type = ClientMessage;
  event.xclient.window = std::stoul(window);
  event.xclient.message_type = ::XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(::XInternAtom(display, "WM_DELETE_WINDOW", False));
  ::XSendEvent(display, event.xclient.window, False, NoEventMask, &event);
  ::XCloseDisplay(display);
}

/// A run of `unshot view` on that screen, in a folder of its own.
class WindowRun {
 public:
  explicit WindowRun(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"view"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    run_ = std::make_unique<ProgramRun>(folder_.path(), all);
    opened_ = eventually([&] {
      window_ = xdotool("search --onlyvisible --name Unshot");
      return !window_.empty() || !run_->running();
    });
    if (window_.empty()) ADD_FAILURE() << "no window: " << run_->errorsSoFar();
  }
  ~WindowRun() {
    if (run_->running()) run_->send(SIGKILL);
    run_->wait();
  }

  const TempFolder& folder() const { return folder_; }
  const std::string& window() const { return window_; }
  bool running() { return run_->running(); }
  /// What it has said so far.
  std::string errors() const { return run_->errorsSoFar(); }
  std::string title() const { return xdotool("getwindowname " + window_); }
  bool hasTitle(const std::string& title_wanted) {
    return eventually([&] { return title() == title_wanted || !running(); }) && running();
  }
  void key(const std::string& name) const { xdotool("key " + name); }

  /// The picture that a key of screenshots writes next: its file's name in folder().
  std::string screenshot(const std::string& key_name = "ctrl+F12") {
    const std::set<std::string> before = folder_.names();
    key(key_name);
    std::string name;
    const bool written = eventually([&] {
      for (const std::string& found : folder_.names()) {
        if (found.ends_with(".png") && !before.contains(found)) name = found;
      }
      return !name.empty() || !running();
    });
    if (!written || name.empty()) ADD_FAILURE() << "no screenshot: " << run_->errorsSoFar();
    return name;
  }
  /// The bytes of a picture of the scene.
  std::string scene() { return folder_.read(screenshot()); }
  /// Two pictures after each other are the same; returns it, or nothing when time is up.
  std::string sceneAtRest() {
    std::string last = scene();
    const bool rests = eventually([&] {
      const std::string next = scene();
      const bool same = next == last;
      last = next;
      return same || testing::Test::HasFailure();
    });
    if (!rests) ADD_FAILURE() << "the picture does not come to rest";
    return last;
  }
  bool sceneChanges(const std::string& from) {
    return eventually([&] { return scene() != from || testing::Test::HasFailure(); });
  }

  /// Waits for its end.
  ProgramResult end() {
    if (!eventually([&] { return !running(); })) {
      ADD_FAILURE() << "does not end";
      run_->send(SIGKILL);
    }
    return run_->wait();
  }

  /// That this key ends it, and that all was well.
  void endsOn(const std::string& key_name) {
    key(key_name);
    const ProgramResult result = end();
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }

 private:
  TempFolder folder_;
  std::unique_ptr<ProgramRun> run_;
  std::string window_;
  bool opened_ = false;
};

}  // namespace unshot::testing_support
