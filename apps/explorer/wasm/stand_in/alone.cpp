/// \file
/// What the library asks of a machine, where there is one thread and the memory that a page may have.

#include "foundation/machine.hpp"
#include "foundation/parallel.hpp"

namespace slipfront {

double usable_memory() { return 0.8e9; }
int sensible_threads(int) { return 1; }

void for_each_parallel(std::size_t count, int, const std::function<void(std::size_t)>& body, std::size_t) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace slipfront
