#pragma once
/// \file
/// Tables of coefficients from the bytes that pack_table.py writes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "friction/ratio/layout.hpp"

namespace slipfront::friction_ratio {

/// The next whole number, after which `byte` is moved.
inline std::int32_t next_number(const unsigned char*& byte) {
  std::uint32_t rest = 0;
  for (int shift = 0;; shift += 7) {
    rest |= static_cast<std::uint32_t>(*byte & 127) << shift;
    if (*byte++ < 128) break;
  }
  const auto half = static_cast<std::int32_t>(rest >> 1);
  return rest % 2 == 0 ? half : -half - 1;
}

template <class Table>
Table unpacked_doubles(const unsigned char* byte, double quantum) {
  std::vector<double> values(sizeof(Table) / sizeof(double));
  for (double& value : values) value = next_number(byte) * quantum;
  Table table;
  std::memcpy(&table, values.data(), sizeof table);
  return table;
}

/// The first half of the table. The second half, that of the closure "paper", is so large that every ratio from it is 0
/// or infinite: a result that uses it cannot look right.
template <class Table>
Table unpacked_half(const unsigned char* byte) {
  std::vector<front_layout::Integer> values(sizeof(Table) / sizeof(front_layout::Integer),
                                            std::numeric_limits<front_layout::Integer>::max());
  std::generate_n(values.begin(), values.size() / 2, [&] { return next_number(byte); });
  Table table;
  std::memcpy(&table, values.data(), sizeof table);
  return table;
}

}  // namespace slipfront::friction_ratio
