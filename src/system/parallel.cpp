#include "system/parallel.hpp"

#include <algorithm>
#include <atomic>

#include "system/team.hpp"
#include "system/threads.hpp"

namespace slipfront {

void for_each_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& body, std::size_t few) {
  const std::size_t chunk = count > 4096 ? 64 : 1;  // small enough to share uneven work evenly
  std::atomic<std::size_t> next = 0;
  FirstException first;
  const std::function<void()> work = [&]() noexcept {
    for (std::size_t begin = next.fetch_add(chunk); begin < count; begin = next.fetch_add(chunk))
      for (std::size_t i = begin; i < std::min(begin + chunk, count); ++i) {
        try {
          body(i);
        } catch (...) {
          first.keep(i);
        }
      }
  };
  {
    const bool worth = threads > 1 && count > few;
    const auto others = start_threads(worth ? std::min(count, static_cast<std::size_t>(threads)) - 1 : 0, work);
    work();
  }
  first.rethrow();
}

}  // namespace slipfront
