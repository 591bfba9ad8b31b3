#include "cli/interrupt.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

namespace unshot {
namespace {

// A signal handler reaches nothing else.
std::atomic<bool> raised_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Where the handler writes a byte for the watch that lives; -1: there is none.
std::atomic<int> watch_end = -1;
constexpr char kRaised = 1, kOver = 0;

void tell(int end, char what) {
  while (::write(end, &what, 1) < 0 && errno == EINTR) {
  }
}

// Made once and never closed, so that a late handler writes nowhere else.
const std::array<int, 2>& watchPipe() {
  static const std::array<int, 2> ends = [] {
    std::array<int, 2> made{};
    if (::pipe(made.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    return made;
  }();
  return ends;
}

// The second signal, of whatever kind, is sent again to the default that ends the program; it arrives when
// this returns.
void raiseFlag(int signal) {
  if (raised_flag.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  const int errno_before = errno;
  if (const int end = watch_end; end >= 0) tell(end, kRaised);
  errno = errno_before;
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

InterruptWatch::InterruptWatch(std::function<void()> wake) {
  const std::array<int, 2>& ends = watchPipe();
  thread_ = std::thread([from = ends[0], wake = std::move(wake)] {
    char what = kOver;
    while (::read(from, &what, 1) < 0 && errno == EINTR) {
    }
    if (what == kRaised) wake();
  });
  watch_end = ends[1];
  if (raised_flag) tell(ends[1], kRaised);
}

InterruptWatch::~InterruptWatch() {
  watch_end = -1;
  tell(watchPipe()[1], kOver);
  thread_.join();
}

CancelToken InterruptFlag::token() const { return CancelToken(raised_flag); }

}  // namespace unshot
