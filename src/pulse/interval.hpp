#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slipfront::pulse {

/// Index of the interval of a rising sequence that holds x; the first or last one for what lies outside.
inline std::size_t interval(const std::vector<double>& rising, double x) {
  const auto above = std::upper_bound(rising.begin(), rising.end(), x);
  const std::size_t i = above == rising.begin() ? 0 : static_cast<std::size_t>(above - rising.begin()) - 1;
  return std::min(i, rising.size() - 2);
}

}  // namespace slipfront::pulse
