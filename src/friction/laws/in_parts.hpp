#pragma once

#include <algorithm>
#include <cstddef>

namespace slipfront::friction {

/// Positions in one pass of the loops over many positions, whose values then fit into the nearest cache.
constexpr std::size_t part_size = 64;

/// Calls `task` with the first position of each part and its size, at most `part_size`.
template <class Task>
void in_parts(std::size_t size, const Task& task) {
  for (std::size_t begin = 0; begin < size; begin += part_size) task(begin, std::min(part_size, size - begin));
}

}  // namespace slipfront::friction
