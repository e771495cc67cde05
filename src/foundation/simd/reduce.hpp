#pragma once

#include <cstddef>

namespace slipfront {

/// Sum or extremum of value(i) over an array, by `join`, from `start`: in eight lanes, in the same order on every
/// machine.
template <class Value, class Join>
inline double reduce(std::size_t size, double start, Value value, Join join) {
  constexpr std::size_t lanes = 8;
  double part[lanes];
  for (double& p : part) p = start;
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes)
    for (std::size_t j = 0; j < lanes; ++j) part[j] = join(part[j], value(i + j));
  for (; i < size; ++i) part[0] = join(part[0], value(i));
  for (std::size_t j = 1; j < lanes; ++j) part[0] = join(part[0], part[j]);
  return part[0];
}

}  // namespace slipfront
