#pragma once

#include <array>
#include <cstddef>

/// Sums of arrays as vector code, for time integrators.
namespace slipfront {

/// sum = c_0 x_0 + c_1 x_1 + ...
void combine3(std::size_t size, std::array<double, 3> c, std::array<const double*, 3> x, double* sum);
void combine5(std::size_t size, std::array<double, 5> c, std::array<const double*, 5> x, double* sum);

}  // namespace slipfront
