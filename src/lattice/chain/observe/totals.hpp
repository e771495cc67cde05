#pragma once

#include <cstddef>
#include <optional>

#include "slipfront/lattice/chain/chain.hpp"
#include "slipfront/lattice/chain/problem.hpp"

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

/// Sums over the chain. Energies and momentum are in units of Eq. 3, in which a dislocation at rest has energy 8.
struct Totals {
  double time = 0;
  double charge = 0;      ///< (u at the left end - u at the right end) / 2 pi; Boundary::charge if periodic
  long dislocations = 0;  ///< number of dislocations and antidislocations
  double kinetic = 0;     ///< sum of u_t^2 / 2
  double elastic = 0;     ///< sum of u_x^2 / 2
  double substrate = 0;   ///< sum of a^2 (1 - cos u), with the present a^2
  double loading = 0;     ///< energy of the springs that load the chain (Loading)
  double momentum = 0;    ///< sum of -u_t u_x
  double steepest = 0;    ///< largest difference of u between neighbours
  /// The first and the last of the sites between which and the next there are dislocations.
  std::optional<std::size_t> first_site, last_site;
  double energy() const { return kinetic + elastic + substrate + loading; }
};

/// (all) The totals at the present time. The order of summation does not depend on the number of threads and ranks.
Totals totals(const Sites& chain);

}  // namespace slipfront::chain
