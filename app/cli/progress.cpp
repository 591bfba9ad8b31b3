#include "cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "base/clock.h"
#include "cli/text.h"

namespace unshot {
namespace {

constexpr double kTerminalInterval = 0.1;
constexpr double kFirstLine = 2;  // plain lines: the first after this time, then at growing intervals
constexpr double kLongestInterval = 60;

bool isTerminal() {
  const char* kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) && kind && std::string_view(kind) != "dumb";
}

std::size_t terminalWidth() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 80;
  return size.ws_col;
}

std::string barOf(double done) {
  constexpr std::size_t kCells = 24;
  const auto full = static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * kCells);
  return "[" + std::string(full, '#') + std::string(kCells - full, '.') + "] ";
}

/// A time that is read while it runs: "0.8 s", "12 s", "3 min 20 s".
std::string runningTime(double seconds) {
  const double step = seconds < 9.95 ? 0.1 : 1;
  const double rounded = step * std::round(seconds / step);
  return rounded < 99.5 ? figureText(rounded) + " s" : durationText(rounded);
}

}  // namespace

Progress::Progress(double max_seconds) : max_seconds_(max_seconds), terminal_(isTerminal()) {
  interval_ = terminal_ ? kTerminalInterval : kFirstLine;
  next_ = wallSeconds() + interval_;
}

Progress::~Progress() { finish(); }

void Progress::phase(const std::string& text) {
  if (terminal_) draw(text + " ...");
}

void Progress::update(const ProgressFigures& figures) {
  if (wallSeconds() >= next_) say(figures.done, "solving: ", lineOf(figures));
}

void Progress::update(double done, const std::string& text) {
  if (wallSeconds() >= next_) say(done, figureText(std::floor(100 * done)) + " %: ", text);
}

void Progress::say(double done, const std::string& plain_head, const std::string& text) {
  const double now = wallSeconds();
  if (terminal_) {
    draw(barOf(done) + text);
  } else {
    std::cerr << plain_head << text << std::endl;
    interval_ = std::min(1.5 * interval_, kLongestInterval);
  }
  next_ = now + interval_;
}

void Progress::finish() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

std::string Progress::lineOf(const ProgressFigures& figures) const {
  std::string line = "unshot " + percentText(figures.unshot_fraction) + ", ";
  if (std::isfinite(figures.bound)) line += "error at most " + percentText(figures.bound) + ", ";
  line += countedText(figures.shots, "shot") + ", " + runningTime(figures.seconds);
  if (figures.done <= 0) return line;
  double left = figures.seconds * (1 - figures.done) / figures.done;
  if (max_seconds_ > 0) left = std::min(left, std::max(0.0, max_seconds_ - figures.seconds));
  return line + ", about " + runningTime(left) + " left";
}

void Progress::draw(const std::string& line) {
  std::cerr << "\r\033[K" << line.substr(0, terminalWidth() - 1) << std::flush;
  drawn_ = true;
}

}  // namespace unshot
