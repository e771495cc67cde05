#include "allocations.hpp"

#if !SLIPFRONT_SANITIZED

#include <cstdlib>
#include <new>

namespace allocations {

thread_local long made = 0;
thread_local long until_failure = -1;

namespace {

void* checked(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void count_one() {
  ++made;
  if (until_failure >= 0 && until_failure-- == 0) throw std::bad_alloc();
}

}  // namespace
}  // namespace allocations

void* operator new(std::size_t size) {
  allocations::count_one();
  return allocations::checked(std::malloc(size > 0 ? size : 1));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  allocations::count_one();
  const auto to = static_cast<std::size_t>(alignment);
  return allocations::checked(std::aligned_alloc(to, (size + to - 1) / to * to));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

#endif
