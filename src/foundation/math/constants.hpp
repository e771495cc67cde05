#pragma once
/// \file
/// Constants that several modules use.

#include <limits>
#include <numbers>

namespace slipfront {

/// One period of the substrate: the slip that a dislocation leaves behind, in b / (2 pi).
inline constexpr double turn = 2 * std::numbers::pi;

/// The value of a number that does not exist, such as the position of a front that has left the domain.
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace slipfront
