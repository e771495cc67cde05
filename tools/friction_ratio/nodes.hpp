#pragma once
/// \file
/// Nodes of Chebyshev polynomials, and the polynomials through values at them.

#include <cmath>
#include <cstddef>
#include <numbers>

#include "friction/ratio/layout.hpp"

namespace slipfront::friction_ratio {

/// Node i of `count` between -1 and 1, the last first.
inline double node(std::size_t i, std::size_t count) {
  return std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(count - 1));
}

/// Coefficient k of the Chebyshev polynomial through `count` values at `node`s: value(i) at node i.
template <class Value>
double coefficient(std::size_t k, std::size_t count, const Value& value) {
  const std::size_t last = count - 1;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double half = i == 0 || i == last ? 0.5 : 1;
    sum += half * value(i) *
           std::cos(std::numbers::pi * static_cast<double>(i * k % (2 * last)) / static_cast<double>(last));
  }
  return sum * (k == 0 || k == last ? 1.0 : 2.0) / static_cast<double>(last);
}

/// Sigma- at node i of the table.
inline double stress_node(std::size_t i) {
  if (i == 0) return layout::most_stress;
  if (i == layout::y_nodes - 1) return layout::least_stress;
  return layout::stress_of(layout::of_stress().at(node(i, layout::y_nodes)));
}

}  // namespace slipfront::friction_ratio
