#pragma once
/// \file
/// Loops on a team of threads that is awake already, and the one way by which exceptions leave loops on several
/// threads.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>

namespace slipfront {

/// Keeps the exception of the lowest index that threw. The result does not depend on the number of threads.
class FirstException {
 public:
  /// Keeps the current exception, that of index i. Several threads may call this at once.
  void keep(std::size_t i) noexcept {
    const std::scoped_lock lock(mutex_);
    if (i >= index_) return;
    index_ = i;
    exception_ = std::current_exception();
  }

  /// Throws the exception that was kept, if any. All threads must have finished.
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr exception_;
  std::size_t index_ = std::numeric_limits<std::size_t>::max();
};

/// Calls part(k), which must not throw, for every k < parts, each on a thread of its own: part 0 on that of the caller.
/// The other threads wait for the next call, at first awake, because a loop is often followed by another. Where the
/// machine provides fewer threads, or the team is busy with another call, the caller does the parts that are left.
void on_team(int parts, const std::function<void(int)>& part);

/// Calls each(i) for every i < count. `threads` threads take `together` of them in turn, or one contiguous part each if
/// that is 0. It is the same part at each call, which the thread then finds in its cache.
template <class Each>
void for_each_on_team(std::size_t count, int threads, const Each& each, long together = 0) {
#ifdef __EMSCRIPTEN__  // a page has one thread
  threads = 1;
#endif
  if (threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) each(i);
    return;
  }
  FirstException first;
  const auto n = static_cast<long>(count);
  if (together == 0) together = (n + threads - 1) / threads;
  on_team(threads, [&](int part) {
    for (long begin = part * together; begin < n; begin += threads * together)
      for (long i = begin; i < std::min(begin + together, n); ++i) {
        try {
          each(static_cast<std::size_t>(i));
        } catch (...) {
          first.keep(static_cast<std::size_t>(i));
        }
      }
  });
  first.rethrow();
}

}  // namespace slipfront
