#include "system/team.hpp"

#include <unistd.h>

#include <atomic>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace slipfront {
namespace {

/// Waits until `number` is no longer `old`: awake for some ten microseconds, in which the next loop usually begins, and
/// then asleep, so that other processes get the core.
void wait_for_change(const std::atomic<int>& number, int old) {
  constexpr int looks = 4000;
  for (int i = 0; i < looks; ++i) {
    if (number.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__) && defined(__GNUC__)
    __builtin_ia32_pause();
#endif
  }
  number.wait(old, std::memory_order_acquire);
}

class Team {
 public:
  /// The threads of this process. It is never destroyed, because threads may wait when a process ends; and a process
  /// that was forked gets another, because it has no threads but its first.
  static Team& of_process() {
    static std::mutex mutex;
    static Team* team = nullptr;
    const std::scoped_lock lock(mutex);
    if (team == nullptr || team->process_ != getpid()) team = new Team;
    return *team;
  }

  void call(int parts, const std::function<void(int)>& part) {
    const std::unique_lock lock(busy_, std::try_to_lock);
    if (lock) {
      start(parts - 1);
      part_ = &part;
      parts_ = parts;
      at_work_.store(size(), std::memory_order_relaxed);
      calls_.fetch_add(1, std::memory_order_release);
      calls_.notify_all();
    }
    part(0);
    for (int k = lock ? size() + 1 : 1; k < parts; ++k) part(k);
    while (lock) {
      const int at_work = at_work_.load(std::memory_order_acquire);
      if (at_work == 0) return;
      wait_for_change(at_work_, at_work);
    }
  }

 private:
  int size() const { return static_cast<int>(threads_.size()); }

  void start(int wanted) {
    try {
      while (size() < wanted) {
        threads_.reserve(threads_.size() + 1);
        threads_.emplace_back([this, number = size() + 1, seen = calls_.load()] { work(number, seen); });
      }
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
  }

  [[noreturn]] void work(int number, int seen) {
    for (;;) {
      wait_for_change(calls_, seen);
      ++seen;  // no call begins before all threads have done their part of this one
      if (number < parts_) (*part_)(number);
      if (at_work_.fetch_sub(1, std::memory_order_acq_rel) == 1) at_work_.notify_one();
    }
  }

  pid_t process_ = getpid();
  std::mutex busy_;
  std::vector<std::thread> threads_;
  std::atomic<int> calls_ = 0, at_work_ = 0;
  int parts_ = 0;
  const std::function<void(int)>* part_ = nullptr;
};

}  // namespace

void on_team(int parts, const std::function<void(int)>& part) { Team::of_process().call(parts, part); }

}  // namespace slipfront
