#pragma once
/// \file
/// Many independent small pieces of work on several threads.

#include <cstddef>
#include <functional>

namespace slipfront {

/// `body(i)` for every i < count, on up to `threads` threads: what it does must not depend on the order. The exception
/// of the lowest i that threw is thrown, whatever the number of threads. A `count` of `few` or less is not worth the
/// start of threads: 256 pieces of a microsecond; 1 where each takes long.
void for_each_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& body,
                       std::size_t few = 256);

}  // namespace slipfront
