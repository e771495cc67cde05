#pragma once
// Counts the allocations of a thread, and lets them fail. The operators are in allocations.cpp.

#include "system/machine.hpp"

#if !SLIPFRONT_SANITIZED

namespace allocations {

extern thread_local long made;           ///< by this thread so far
extern thread_local long until_failure;  ///< allocations until one fails; none does below 0

/// The number of allocations that `work` makes on this thread.
template <class Work>
long count(const Work& work) {
  const long before = made;
  work();
  return made - before;
}

}  // namespace allocations

#endif
