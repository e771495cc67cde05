#pragma once

#include <array>

#include "bindings.hpp"

/// Columns of N numbers, one an element of `make(i)`, all as long as the first input.
template <std::size_t N, class Make>
py::list columns(py::ssize_t count, Make&& make) {
  py::list result;
  std::array<double*, N> out{};
  for (std::size_t k = 0; k < N; ++k) {
    py::array_t<double> column(count);
    out[k] = column.mutable_data();
    result.append(column);
  }
  const py::gil_scoped_release others_may_run;
  for (py::ssize_t i = 0; i < count; ++i) {
    const std::array<double, N> row = make(i);
    for (std::size_t k = 0; k < N; ++k) out[k][i] = row[k];
  }
  return result;
}

/// What is said of each of them.
template <std::size_t N>
py::list all(const std::array<slipfront::Description, N>& about) {
  py::list result;
  for (const slipfront::Description& a : about) result.append(described(a));
  return result;
}
