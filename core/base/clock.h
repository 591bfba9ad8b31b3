// Clocks and memory of this process.
#pragma once

#include <cstddef>

namespace unshot {

/// Seconds of a monotonic wall clock with an arbitrary origin.
double wallSeconds();

/// CPU seconds that all threads of this process have used (so the GL driver's workers are included).
double cpuSeconds();

/// Largest resident set of this process so far [bytes].
std::size_t peakMemoryBytes();

/// Memory that this process could still take without driving others out [bytes].
std::size_t availableMemoryBytes();

}  // namespace unshot
