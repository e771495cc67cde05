#pragma once
/// \file
/// A table of doubles from whole numbers and powers of ten (pack_table.py).

#include <cmath>
#include <cstdint>
#include <cstring>

#include "friction_ratio/coefficients.hpp"

namespace slipfront::friction_ratio {

template <class Table, std::size_t n>
Table unpacked(const std::int32_t (&mantissas)[n], const std::int8_t (&powers)[n]) {
  static constexpr double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  static_assert(sizeof(Table) == n * sizeof(double));
  static double values[n];
  for (std::size_t i = 0; i < n; ++i)
    values[i] = powers[i] < 0 ? mantissas[i] / tens[-powers[i]] : mantissas[i] * tens[static_cast<int>(powers[i])];
  Table table;
  std::memcpy(&table, values, sizeof table);
  return table;
}

}  // namespace slipfront::friction_ratio
