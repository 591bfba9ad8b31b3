// Threads that share out work whose parts depend in nothing on each other.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace unshot {

/// Used by one thread, which does its share of the work.
class Workers {
 public:
  /// What does part `part`; no two at a time have the same `worker`, which is below count().
  using Work = std::function<void(std::size_t part, unsigned worker)>;

  /// As many as `threads` with the calling one; 0: as the machine has cores. They start with the first work
  /// that has parts for them, and go with the object.
  explicit Workers(unsigned threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  unsigned count() const { return count_; }
  /// Does all parts, in any order, and waits for them. What one of them throws is thrown once none is under
  /// way; parts that were not begun by then stay undone.
  void run(std::size_t parts, const Work& work);

 private:
  void start();
  void serve(unsigned worker);
  void takeParts(std::unique_lock<std::mutex>& lock, unsigned worker);

  unsigned count_;
  std::mutex mutex_;
  std::condition_variable begun_, done_;
  // All of this under the mutex:
  const Work* work_ = nullptr;
  std::size_t next_ = 0, end_ = 0;
  unsigned busy_ = 0;  // threads at a part
  bool ending_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;  // last: they use all of the above
};

}  // namespace unshot
