#include "cli/interrupt.h"

#include <csignal>

namespace unshot {
namespace {

// A signal handler reaches nothing else.
volatile std::sig_atomic_t raised_signal = 0;

void raiseFlag(int signal) { raised_signal = signal; }

void setHandler(int signal, bool ours) {
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = ours ? raiseFlag : SIG_DFL;
  // After the first signal the default is back, so the second one ends the program.
  action.sa_flags = ours ? static_cast<int>(SA_RESETHAND | SA_RESTART) : 0;
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
  raised_signal = 0;
  for (const int signal : kSignals) {
    if (isOurs(signal)) setHandler(signal, true);
  }
}

InterruptFlag::~InterruptFlag() {
  for (const int signal : kSignals) {
    if (isOurs(signal)) setHandler(signal, false);
  }
}

bool InterruptFlag::raised() const { return raised_signal != 0; }

}  // namespace unshot
