#pragma once
/// \file
/// What this machine has for one process, wall time, and whether this is a build under AddressSanitizer.

#include <chrono>

namespace slipfront {

/// Bytes of memory: of the machine, of the control groups that hold this process, and of its own limit, whichever is
/// least. Infinity where nothing is known.
double usable_memory();

/// The processor cores that this process may use, but no more than the environment variable OMP_NUM_THREADS allows.
int usable_cores();

/// `wanted` threads, but no more than can be of use: many that do nothing take memory.
int sensible_threads(int wanted);

}  // namespace slipfront

#if defined(__SANITIZE_ADDRESS__)
#define SLIPFRONT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SLIPFRONT_SANITIZED 1
#endif
#endif
#ifndef SLIPFRONT_SANITIZED
#define SLIPFRONT_SANITIZED 0
#endif

namespace slipfront {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace slipfront
