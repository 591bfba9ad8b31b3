// Ctrl-C while a command runs: a flag that is looked at between its steps and while it loads a scene.
#pragma once

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

}  // namespace unshot
