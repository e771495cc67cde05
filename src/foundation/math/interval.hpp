#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slipfront {

/// Index of the interval of a rising sequence that holds x; the first or last one for what lies outside.
inline std::size_t interval(const double* rising, std::size_t size, double x) {
  const double* above = std::upper_bound(rising, rising + size, x);
  const std::size_t i = above == rising ? 0 : static_cast<std::size_t>(above - rising) - 1;
  return std::min(i, size - 2);
}
inline std::size_t interval(const std::vector<double>& rising, double x) {
  return interval(rising.data(), rising.size(), x);
}

}  // namespace slipfront
