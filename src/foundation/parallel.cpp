#include "foundation/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace slipfront {
namespace {

/// The work that the threads share, in chunks small enough to share uneven work evenly.
class Work {
 public:
  Work(std::size_t count, const std::function<void(std::size_t)>& body)
      : count_(count), chunk_(count > 4096 ? 64 : 1), body_(body) {}

  /// Carries out chunks until none is left.
  void go() noexcept {
    for (std::size_t begin = next_.fetch_add(chunk_); begin < count_; begin = next_.fetch_add(chunk_))
      for (std::size_t i = begin; i < std::min(begin + chunk_, count_); ++i) attempt(i);
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void attempt(std::size_t i) noexcept {
    try {
      body_(i);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (i < thrown_at_) {
        thrown_at_ = i;
        thrown_ = std::current_exception();
      }
    }
  }

  std::size_t count_, chunk_;
  const std::function<void(std::size_t)>& body_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr thrown_;
  std::size_t thrown_at_ = count_;
};

/// Threads that help with `work`. Where the machine gives no more of them, those that are there do it all: OpenMP would
/// end the program.
std::vector<std::jthread> helpers(Work& work, std::size_t wanted) {
  std::vector<std::jthread> all;
  try {
    all.reserve(wanted);
    for (std::size_t i = 0; i < wanted; ++i) all.emplace_back([&work] { work.go(); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  return all;
}

}  // namespace

void for_each_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& body, std::size_t few) {
  Work work(count, body);
  {
    const bool worth = threads > 1 && count > few;
    const auto helping = helpers(work, worth ? std::min(count, static_cast<std::size_t>(threads)) - 1 : 0);
    work.go();
  }
  work.rethrow();
}

}  // namespace slipfront
