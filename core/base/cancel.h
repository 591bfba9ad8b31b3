// Giving up long work, and how far it is: who waits raises a flag, the work looks at it between its items and
// says how much of it is done.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <utility>

namespace unshot {

/// Thrown by work that was given up. Nobody's error, so no std::exception: whoever raised the flag catches
/// it.
struct Cancelled {};

/// Items of a loop between two words on how much of it is done.
inline constexpr std::uint32_t kToldEvery = 1024;

/// By default work that runs to its end, and tells nobody how far it is. Copies look at the same flag and
/// tell the same `told`, which outlive them.
class CancelToken {
 public:
  /// Takes how much is done, from 0 to 1; called on the thread that does the work.
  using Told = std::function<void(double done)>;

  CancelToken() = default;
  explicit CancelToken(const std::atomic<bool>& flag, const Told* told = nullptr)
      : flag_(&flag), told_(told) {}

  bool requested() const { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// Throws Cancelled where the flag is raised. Costs a load: it may stand in any loop but the innermost.
  void check() const {
    if (requested()) throw Cancelled();
  }
  /// So much of this work is done, from 0 to 1. Not for inner loops, nor for threads that help.
  void report(double done) const {
    if (told_ && *told_) (*told_)(from_ + done * (to_ - from_));
  }
  /// For a part of the work, which begins and ends at these shares of it.
  CancelToken part(double from, double to) const {
    CancelToken out = *this;
    out.from_ = from_ + from * (to_ - from_);
    out.to_ = from_ + to * (to_ - from_);
    return out;
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
  const Told* told_ = nullptr;
  double from_ = 0, to_ = 1;
};

}  // namespace unshot
