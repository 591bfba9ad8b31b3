// Giving up long work: who waits raises a flag, the work looks at it between its items.
#pragma once

#include <atomic>
#include <utility>

namespace unshot {

/// Thrown by work that was given up. Nobody's error, so no std::exception: whoever raised the flag catches
/// it.
struct Cancelled {};

/// By default work that runs to its end. Copies look at the same flag, which outlives them.
class CancelToken {
 public:
  CancelToken() = default;
  explicit CancelToken(const std::atomic<bool>& flag) : flag_(&flag) {}

  bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// Throws Cancelled where the flag is raised. Costs a load: it may stand in any loop but the innermost.
  void check() const {
    if (requested()) throw Cancelled();
  }
  /// `less` for a sort that may be given up.
  template <class Less>
  auto checking(Less less) const {
    return [this, less = std::move(less)](const auto& a, const auto& b) {
      check();
      return less(a, b);
    };
  }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

}  // namespace unshot
