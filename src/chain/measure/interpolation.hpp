#pragma once

#include <vector>

#include "slipfront/chain/problem.hpp"

namespace slipfront::chain {

/// Lagrange interpolation of v through the (up to) six sites around r (counted in sites of v).
double interpolated(const std::vector<double>& v, double r);

/// Integral of the interpolant over [from, to], in sites.
double integral(const std::vector<double>& v, double from, double to);

/// \throws InputError: a window that is not on the chain, or has no width.
[[noreturn]] void refuse_window(const Grid& grid, double x, double width);

}  // namespace slipfront::chain
