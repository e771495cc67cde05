#pragma once
/// \file
/// Constants that several modules use.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace slipfront {

/// One period of the substrate: the slip that a dislocation leaves behind, in b / (2 pi).
inline constexpr double turn = 2 * std::numbers::pi;

/// The value of a number that does not exist, such as the position of a front that has left the domain.
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

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
