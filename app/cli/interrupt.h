// Ctrl-C while a solve runs: a flag that is looked at between steps.
#pragma once

namespace unshot {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP only raises the flag; the second one of a kind ends
/// the program. One at a time.
class InterruptFlag {
 public:
  InterruptFlag();
  ~InterruptFlag();
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;

  bool raised() const;
};

}  // namespace unshot
