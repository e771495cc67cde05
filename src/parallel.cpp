#include "slipfront/parallel.hpp"

#include <exception>

namespace slipfront {

void for_each_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& body, std::size_t few) {
  std::exception_ptr thrown;
  std::size_t thrown_at = count;
// Pieces small enough to share uneven work evenly.
#pragma omp parallel for schedule(dynamic, count > 4096 ? 64 : 1) num_threads(threads) if (threads > 1 && count > few)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      body(i);
    } catch (...) {
#pragma omp critical
      if (i < thrown_at) {
        thrown_at = i;
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace slipfront
