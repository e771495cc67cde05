#pragma once
/// \file
/// Many independent small pieces of work on several threads.

#include <cstddef>
#include <functional>

namespace slipfront {

/// `body(i)` for every i < count, on up to `threads` threads: what it does must not depend on the order. The exception
/// of the lowest i that threw is thrown, whatever the number of threads.
void for_each_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace slipfront
