#pragma once

#include "slipfront/chain/chain.hpp"

namespace slipfront::chain {

/// Sums over the chain. Energies and momentum in units of Eq. 3 (a dislocation at rest has energy 8).
struct Totals {
  double time = 0;
  double charge = 0;           ///< (u at the left end - u at the right end) / 2 pi; of a periodic chain, its charge
  long dislocations = 0;       ///< of either sign
  double kinetic = 0;          ///< sum of u_t^2 / 2
  double elastic = 0;          ///< of u_x^2 / 2
  double substrate = 0;        ///< of a^2 (1 - cos u), a^2 as it is now
  double loading = 0;          ///< in the springs that pull (Loading)
  double momentum = 0;         ///< of -u_t u_x
  double supplied_rate = 0;    ///< power of F, sum of F u_t
  double dissipated_rate = 0;  ///< of friction, sum of f(u_t) u_t
  double steepest = 0;         ///< largest difference of u between neighbours
  double energy() const { return kinetic + elastic + substrate + loading; }
};

/// (all) At the present time. The sums are taken in the same order for any number of threads and ranks.
Totals totals(const Sites& chain);

/// Work since the first sample, by the trapezoidal rule between samples (every few time units for a long chain, where
/// the rates are smooth; every few steps for one dislocation).
struct Work {
  double time = 0, supplied_rate = 0, dissipated_rate = 0;  ///< of the last sample
  double supplied = 0, dissipated = 0;
  bool started = false;

  void sample(const Totals& now);
};

}  // namespace slipfront::chain
