#pragma once
/// \file
/// Measurements of a run at one time: profiles on a fixed grid, fronts, energies.

#include <vector>

#include "averages/pulse/observe/fronts.hpp"
#include "averages/pulse/solver.hpp"
#include "slipfront/text/output/snapshot.hpp"

namespace slipfront::pulse {

/// Energy of the interface now. The energy 8 a(x) of each isolated dislocation is summed separately. Without a contact
/// profile it is constant, and rounding of this large number then does not affect small changes of the others.
struct StoredEnergy {
  double isolated;     ///< energy of the dislocations if each were isolated and at rest
  double interaction;  ///< elastic energy in excess of that
  double kinetic;
  double correction;  ///< part of the sums that comes from differences between cells; the truncation error is smaller
  double unresolved;  ///< kinetic energy of cells where it is not smooth, as for a pulse narrower than a cell

  double elastic() const { return isolated + interaction; }
  double all() const { return elastic() + kinetic; }
};
StoredEnergy stored_energy(const Solver& solver);

/// Energies of a snapshot, except `shocks` and `phonons`, which are NaN.
output::Energy energy_of(const Solver& solver, const View& view);

/// Relative error of the number of dislocations, |counted - expected| / expected. We count with Simpson's rule over the
/// densities at the faces and centres of the cells. Expected are the dislocations at t = 0 and those that have entered.
/// The error is that of the states and not only rounding: 1e-6 for smooth profiles with 400 cells, more if shocks or
/// free edges span few cells.
double conservation_error(const Solver& solver);

/// Everything of a snapshot. `x_edges` ascend; `threshold` is the observer's, as a share of the peak slip velocity.
output::Snapshot observe(const Solver& solver, const std::vector<double>& x_edges,
                         const TrailingCharacteristic& trailing, double threshold);

}  // namespace slipfront::pulse
