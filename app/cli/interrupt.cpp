#include "cli/interrupt.h"

#include <atomic>
#include <csignal>

namespace unshot {
namespace {

// A signal handler reaches nothing else.
std::atomic<bool> raised_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The second signal, of whatever kind, is sent again to the default that ends the program; it arrives when
// this returns.
void raiseFlag(int signal) {
  if (raised_flag.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

// SA_RESTART: a write that waits for its reader is not given up at the first signal.
void setHandler(int signal, bool ours) {
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = ours ? raiseFlag : SIG_DFL;
  action.sa_flags = ours ? SA_RESTART : 0;
  sigaction(signal, &action, nullptr);
}

bool isIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

// A script that starts us in the background may have SIGINT ignored, yet a SIGINT sent to us is meant; nohup
// means what it says.
bool isOurs(int signal) { return signal != SIGHUP || !isIgnored(signal); }

}  // namespace

InterruptFlag::InterruptFlag() {
  raised_flag = false;
  for (const int signal : kSignals) {
    if (isOurs(signal)) setHandler(signal, true);
  }
}

InterruptFlag::~InterruptFlag() {
  for (const int signal : kSignals) {
    if (isOurs(signal)) setHandler(signal, false);
  }
}

bool InterruptFlag::raised() const { return raised_flag; }

CancelToken InterruptFlag::token() const { return CancelToken(raised_flag); }

}  // namespace unshot
