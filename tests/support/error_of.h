// The Error that a call throws.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "base/error.h"

namespace unshot::testing_support {

inline Error errorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no Error";
  return Error(ErrorKind::kInternal, "none");
}

}  // namespace unshot::testing_support
