// How the program ends.
#pragma once

#include "base/error.h"

namespace unshot {

inline constexpr int kExitDone = 0;
inline constexpr int kExitInternal = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitInput = 3;
inline constexpr int kExitEnvironment = 4;
inline constexpr int kExitNotConverged = 5;   ///< within the limits given; the result is written
inline constexpr int kExitDifferent = 6;      ///< a comparison exceeded its tolerance
inline constexpr int kExitInterrupted = 130;  ///< what was reached is written

inline int exitCodeOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return kExitUsage;
    case ErrorKind::kInput:
      return kExitInput;
    case ErrorKind::kEnvironment:
      return kExitEnvironment;
    case ErrorKind::kInternal:
      break;
  }
  return kExitInternal;
}

}  // namespace unshot
