#pragma once

#include <array>

#include "bindings.hpp"

/// Calls make(i), which returns N numbers, for i = 0 ... count - 1. Returns a list of N arrays of length `count`; array
/// k holds the k-th number of each call.
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

/// The descriptions as a list of tuples; see described().
template <std::size_t N>
py::list all(const std::array<slipfront::Description, N>& about) {
  py::list result;
  for (const slipfront::Description& a : about) result.append(described(a));
  return result;
}
