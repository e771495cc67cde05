#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

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
  double energy() const { return kinetic + elastic + substrate + loading; }
};

/// (all) The totals at the present time. The order of summation does not depend on the number of threads and ranks.
Totals totals(const Sites& chain);

}  // namespace slipfront::chain
