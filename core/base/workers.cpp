#include "base/workers.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace unshot {

Workers::Workers(unsigned threads)
    : count_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(std::size_t parts, const Work& work) {
  if (parts > 1) start();
  std::unique_lock lock(mutex_);
  work_ = &work;
  next_ = 0;
  end_ = parts;
  if (parts > 1 && !threads_.empty()) begun_.notify_all();
  takeParts(lock, 0);
  done_.wait(lock, [this] { return busy_ == 0; });
  work_ = nullptr;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

// A machine that has no more threads to give lets those that there are do it all.
void Workers::start() {
  while (threads_.size() + 1 < count_) {
    try {
      const auto worker = static_cast<unsigned>(threads_.size() + 1);
      threads_.emplace_back([this, worker] { serve(worker); });
    } catch (const std::system_error&) {
      count_ = static_cast<unsigned>(threads_.size() + 1);
    }
  }
}

void Workers::serve(unsigned worker) {
  std::unique_lock lock(mutex_);
  while (true) {
    begun_.wait(lock, [this] { return ending_ || next_ < end_; });
    if (ending_) return;
    takeParts(lock, worker);
  }
}

void Workers::takeParts(std::unique_lock<std::mutex>& lock, unsigned worker) {
  while (next_ < end_) {
    const std::size_t part = next_++;
    const Work& work = *work_;
    ++busy_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      work(part, worker);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    --busy_;
    if (failure) {
      next_ = end_;
      if (!failure_) failure_ = failure;
    }
  }
  if (busy_ == 0) done_.notify_all();
}

}  // namespace unshot
