// Memory set aside for what has to be done once there is no more: to say so, to show and to save what is
// there.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace unshot {

/// Used by one thread.
class MemoryReserve {
 public:
  /// Sets `bytes` aside, as far as there is memory for it: untouched, they are addresses only.
  explicit MemoryReserve(std::size_t bytes) : bytes_(bytes) { refill(); }

  /// Lets go of it: what is allocated next finds room there.
  void release() { block_.reset(); }
  /// Sets it aside again once there is memory.
  void refill() {
    if (!block_) block_.reset(new (std::nothrow) char[bytes_]);
  }

 private:
  std::size_t bytes_;
  std::unique_ptr<char[]> block_;
};

}  // namespace unshot
