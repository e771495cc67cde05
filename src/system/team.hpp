#pragma once
/// \file
/// Loops on a team of threads that is awake already, and the one way by which exceptions leave loops on several
/// threads.

#include <cstddef>
#include <exception>
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

/// Calls each(i) for every i < count. The `threads` OpenMP threads take `together` of them in turn, or one contiguous
/// part each if that is 0. It is the same part at each call, which the thread then finds in its cache. The threads wait
/// between calls, which makes short loops worthwhile.
template <class Each>
void for_each_on_team(std::size_t count, int threads, const Each& each, long together = 0) {
  if (threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) each(i);
    return;
  }
  FirstException first;
  const auto n = static_cast<long>(count);
  if (together == 0) together = (n + threads - 1) / threads;
#ifdef _OPENMP
#pragma omp parallel for num_threads(threads) schedule(static, together)
#endif
  for (long i = 0; i < n; ++i) {
    try {
      each(static_cast<std::size_t>(i));
    } catch (...) {
      first.keep(static_cast<std::size_t>(i));
    }
  }
  first.rethrow();
}

}  // namespace slipfront
