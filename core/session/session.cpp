#include "session/session.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "base/thread_priority.h"
#include "session/live_solve.h"

namespace unshot {
namespace {

// Others let go of memory meanwhile.
constexpr std::chrono::milliseconds kBeforeAnotherTry{50};

}  // namespace

struct Session::Impl {
  const SessionSetup setup;
  std::atomic<bool> closing{false}, given_up{false};  // given_up: what is being loaded
  std::atomic<bool> save_given_up{false}, closed{false};
  std::atomic<bool> nobody_waits{false};  // for the thread to end
  std::atomic<double> interval{PublishPace::kLeastInterval};

  mutable std::mutex mutex;  // of what follows
  std::condition_variable arrived;
  std::deque<Command> queue;
  std::optional<Command> current;  // what is being carried out
  std::uint64_t sent = 0;
  int holds = 0;
  std::shared_ptr<const SessionState> latest = std::make_shared<const SessionState>();

  std::thread thread;  // last: it uses all of the above

  explicit Impl(SessionSetup setup_in) : setup(std::move(setup_in)) {
    thread = std::thread([this] {
      workInBackground();
      run();
      closed = true;
      if (nobody_waits && setup.wake) setup.wake();
    });
  }
  ~Impl() { close(); }

  void beginClosing() {
    {
      const std::lock_guard lock(mutex);
      closing = given_up = true;
    }
    arrived.notify_all();
  }
  void close() {
    beginClosing();
    if (thread.joinable()) thread.join();
  }

  void send(Command command) {
    {
      const std::lock_guard lock(mutex);
      if (current && isSuperseded(*current, command)) given_up = true;
      auto* const edit = std::get_if<command::Edit>(&command);
      const auto* const former = queue.empty() ? nullptr : std::get_if<command::Edit>(&queue.back());
      if (edit && former) {
        edit->instead_of = former->instead_of + 1;
        queue.pop_back();
      }
      queue.push_back(std::move(command));
      ++sent;
    }
    arrived.notify_all();
  }

  void hold(int more) {
    {
      const std::lock_guard lock(mutex);
      holds += more;
    }
    arrived.notify_all();
  }

  void run();
  void finish(LiveSolve& live);
  std::optional<Command> next(bool idle);
  void publish(std::shared_ptr<const SessionState> state);
  /// For what is left at the end see finish().
  bool noneWaits() const {
    const std::lock_guard lock(mutex);
    return queue.empty() && !closing;
  }
};

void Session::Impl::run() {
  LiveSolve live({.gl = setup.gl,
                  .publish = [this](std::shared_ptr<const SessionState> state) { publish(std::move(state)); },
                  .none_waits = [this] { return noneWaits(); },
                  .given_up = &given_up,
                  .save_given_up = &save_given_up,
                  .interval = &interval,
                  .kept = setup.kept});
  bool shaken = false;  // what was to be published is still to be
  while (!closing) {
    try {
      if (shaken) live.recover();
      shaken = false;
      if (const std::optional<Command> command = next(!live.running() && !live.hasSpareWork()))
        live.carryOut(*command);
      else if (live.running() && !closing)
        live.step();
      else if (!command && !closing && live.hasSpareWork())
        live.spareWork();
    } catch (const std::bad_alloc&) {
      if (shaken) std::this_thread::sleep_for(kBeforeAnotherTry);
      shaken = true;
    }
  }
  try {
    finish(live);
  } catch (const std::bad_alloc&) {
  }
}

// What was to be saved is saved, and what comes before it done; loading is given up at once.
void Session::Impl::finish(LiveSolve& live) {
  std::deque<Command> left;
  {
    const std::lock_guard lock(mutex);
    left.swap(queue);
  }
  while (!left.empty() && !std::holds_alternative<command::Save>(left.back())) left.pop_back();
  for (const Command& command : left) live.carryOut(command);
  live.finish();
}

// The next command, waited for where the thread is idle or held; none where there is none yet, or where the
// session closes.
std::optional<Command> Session::Impl::next(bool idle) {
  std::unique_lock lock(mutex);
  arrived.wait(lock, [&] { return closing || !queue.empty() || (!idle && holds == 0); });
  if (closing || queue.empty()) return std::nullopt;
  current = std::move(queue.front());
  queue.pop_front();
  given_up = std::any_of(queue.begin(), queue.end(),
                         [this](const Command& later) { return isSuperseded(*current, later); });
  return current;
}

void Session::Impl::publish(std::shared_ptr<const SessionState> state) {
  {
    const std::lock_guard lock(mutex);
    latest.swap(state);  // the state before is let go of outside the lock
  }
  state.reset();
  if (setup.wake) setup.wake();
}

Session::Session(SessionSetup setup) : impl_(std::make_unique<Impl>(std::move(setup))) {}

Session::~Session() = default;

void Session::close() { impl_->close(); }

void Session::beginClosing() {
  impl_->nobody_waits = true;
  impl_->beginClosing();
}

bool Session::closed() const { return impl_->closed; }

Session::Hold::Hold(Session& session) : session_(session) { session_.impl_->hold(1); }

Session::Hold::~Hold() { session_.impl_->hold(-1); }

void Session::open(std::filesystem::path scene, SolveOptions options) {
  impl_->send(command::Open{std::move(scene), std::move(options), {}, false});
}

void Session::resumeSaved(std::filesystem::path scene, SolveOptions options, std::filesystem::path saved,
                          bool error_given) {
  impl_->send(command::Open{std::move(scene), std::move(options), std::move(saved), error_given});
}

void Session::giveUpLoading() {
  const std::lock_guard lock(impl_->mutex);  // next() sets it anew for the next command
  impl_->given_up = true;
}

// A save that has not begun is not meant: each sets it anew.
void Session::giveUpSaving() { impl_->save_given_up = true; }

void Session::restart(SolveOptions options) { impl_->send(command::Restart{std::move(options)}); }

void Session::shootAgain() { impl_->send(command::ShootAgain{}); }

void Session::edit(std::vector<Material> materials) { impl_->send(command::Edit{std::move(materials)}); }

void Session::pause() { impl_->send(command::Pause{}); }

void Session::resume() { impl_->send(command::Resume{}); }

void Session::step(std::uint64_t shots) { impl_->send(command::Step{shots}); }

void Session::setMode(std::string key) { impl_->send(command::SetMode{std::move(key)}); }

void Session::setError(double error) { impl_->send(command::SetError{error}); }

void Session::completeBounces() { impl_->send(command::CompleteBounces{true}); }

void Session::giveUpBounces() { impl_->send(command::CompleteBounces{false}); }

void Session::lookInto(const InsightWanted& wanted) { impl_->send(command::LookInto{wanted}); }

void Session::race(std::string mode) { impl_->send(command::Race{std::move(mode)}); }

void Session::endRace() { impl_->send(command::EndRace{}); }

void Session::save(std::filesystem::path path) { impl_->send(command::Save{std::move(path)}); }

std::uint64_t Session::sent() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->sent;
}

std::shared_ptr<const SessionState> Session::latest() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->latest;
}

void Session::setPublishInterval(double seconds) { impl_->interval = PublishPace::interval(seconds); }

}  // namespace unshot
