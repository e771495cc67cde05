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

/// The pace of a computation since a moment at which a number that grows steadily, such as a time, was `from`.
class Pace {
 public:
  explicit Pace(double from) : from_(from) {}
  double seconds() const { return seconds_since(start_); }
  /// Seconds until the number is `end` if it is `now`, at the pace so far; 0 if it has not grown.
  double seconds_left(double now, double end) const { return now > from_ ? seconds_each(now) * (end - now) : 0; }
  /// Seconds in which the number has grown by 1.
  double seconds_each(double now) const { return seconds() / (now - from_); }

 private:
  double from_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace slipfront
