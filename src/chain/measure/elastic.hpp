#pragma once

#include <cstddef>

#include "slipfront/chain/problem.hpp"

namespace slipfront::chain {

/// Elastic energy that belongs to site j of n, over the spacing h: of the bond to its right and, on a grid, with the
/// next two terms of u_x^2 = (2 asinh(D / 2))^2 / h^2, D the difference over a bond. Reads u from j - 1 to j + 2, as
/// far as there are sites.
template <class Displacement>
double elastic_energy(const Displacement& u, std::size_t j, std::size_t n, double h, Model model) {
  if (j + 1 >= n) return 0;
  const double rise = u(j + 1) - u(j);
  double energy = rise * rise / 2;
  if (model == Model::sine_gordon && j > 0) {
    const double bend = u(j + 1) - 2 * u(j) + u(j - 1);
    energy += bend * bend / 24;
    if (j + 2 < n) {
      const double third = u(j + 2) - 3 * u(j + 1) + 3 * u(j) - u(j - 1);
      energy += third * third / 180;
    }
  }
  return energy / (h * h);
}

}  // namespace slipfront::chain
