#pragma once

#include "pulse/solver.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::pulse {

/// Energy of the interface now. An isolated dislocation has 8 a(x), which nothing changes without a contact profile, so
/// that small changes of the rest are no differences of large numbers.
struct StoredEnergy {
  double isolated;     ///< of the dislocations as if each were isolated and at rest
  double interaction;  ///< elastic energy in addition to that
  double kinetic;
  double correction;  ///< part of the sum that comes from differences between cells: its truncation error is less
  double unresolved;  ///< kinetic energy of the cells where it is not smooth, as of a pulse narrower than a cell

  double elastic() const { return isolated + interaction; }
  double all() const { return elastic() + kinetic; }
};
StoredEnergy stored_energy(const Solver& solver);

/// Energies of a snapshot, but for those that are known from others.
output::Energy energy_of(const Solver& solver, const View& view);

/// |dislocations counted - those there must be|, over the latter. Counted by Simpson's rule over the density that the
/// states of cells and faces mean; there must be those at t = 0 and those that came in. It is the error of the states,
/// not only rounding: 1e-6 for smooth profiles of 400 cells, more where shocks or free edges lie within few cells.
double conservation_error(const Solver& solver);

}  // namespace slipfront::pulse
