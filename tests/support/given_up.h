// Work that is given up on the way.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "base/cancel.h"

namespace unshot::testing_support {

/// Does the work and gives it up once it says that this share of it is done. Returns how far it came; it is
/// to end by Cancelled and to say no less than before each time.
inline double givenUpAt(double share, const std::function<void(const CancelToken&)>& work) {
  std::atomic<bool> given_up{false};
  double last = -1;
  const CancelToken::Told told = [&](double done) {
    EXPECT_GE(done, last);
    last = done;
    if (done >= share) given_up = true;
  };
  EXPECT_THROW(work(CancelToken(given_up, &told)), Cancelled) << share;
  return last;
}

}  // namespace unshot::testing_support
