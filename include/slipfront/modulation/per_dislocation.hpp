#pragma once
/// \file
/// The same equations carried by the dislocations (docs/theory.md 3.4): with q counting them, l_t = U_q and M_t + p_q =
/// 2 pi F
/// - friction. A relativistic gas of particles of mass 8 that repel with the pressure p = 2 sinh^2 psi.

#include "slipfront/train/train.hpp"

namespace slipfront::modulation {

/// Spacing and momentum of one dislocation.
struct LagrangianState {
  double spacing;   ///< l = 2 pi / k = 2 K / (cosh phi cosh psi)
  double momentum;  ///< M = 2 pi P / k = 8 sinh phi cosh psi E
};

/// For psi > 0. \throws InputError otherwise.
LagrangianState lagrangian_state(const State& state);

/// The state with this spacing (> 0, finite) and momentum (finite): one monotone scalar equation,
/// l sqrt(cosh^2 psi + (M / 8 E)^2) = 2 K. `psi_guess` > 0 saves iterations when it is near. Spacings beyond what a
/// double's psi can express (l > 1400) give the empty state at the momentum's velocity. \throws NumericsError outside
/// psi < 700.
State state_of(const LagrangianState& train, double psi_guess);

/// The same with what else the solve has found.
struct SolvedState {
  State state;
  double sound_speed;  ///< c0, 0 if empty
  double EK;           ///< E K, which tells the closures of viscous friction apart
};
SolvedState solve_state(const LagrangianState& train, double psi_guess);

/// Mass of a dislocation in a train, less that of an isolated one and over it, cosh(psi) E - 1, without cancellation.
double mass_excess(double psi);

/// Energy of a dislocation in a train at rest, less that of an isolated one, 8.
double interaction_energy(double psi);

/// Energy of a dislocation less that of one at rest in a train of the same spacing: never negative, and to full
/// relative precision however slow the train is.
double kinetic_energy(const State& state);

}  // namespace slipfront::modulation
