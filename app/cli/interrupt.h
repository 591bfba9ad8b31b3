// Ctrl-C while a command runs: a flag that is looked at between its steps and while it loads a scene.
#pragma once

#include <functional>
#include <thread>

#include "base/cancel.h"

namespace unshot {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP only raises the flag; the second one, of whatever
/// kind, ends the program at once. One at a time.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  bool raised() const;
  /// Asks for an end once the flag is raised.
  CancelToken token() const;
};

/// For who sleeps until something happens: calls `wake` on a thread of its own when the flag is raised, once
/// at most. Within the life of a flag; one at a time.
class InterruptWatch {
 public:
  explicit InterruptWatch(std::function<void()> wake);
  /// Waits for a call under way.
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  std::thread thread_;
};

}  // namespace unshot
