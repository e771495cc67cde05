#pragma once
/// \file
/// Characteristic form of the modulation equations (6): phi +- psi travel at lambda_pm.
/// The conservation laws behind Eqs. (6): dislocation number k and momentum P, the pair that holds across shocks too.
/// The modulation equations in a frame that moves with the dislocations (docs/theory/3_modulation.md 3.4). If q counts
/// the dislocations, the equations are l_t = U_q and M_t + p_q = 2 pi F - friction. They describe a relativistic gas of
/// particles of mass 8 that repel each other with the pressure p = 2 sinh^2 psi.

#include "slipfront/theory/train.hpp"

namespace slipfront::modulation {

/// Speed of small changes of density in the frame of the train, c0 = tanh(psi) K / E, with what goes with it.
struct Sound {
  double c0;         ///< c0, 0 < c0 < 1
  double one_minus;  ///< 1 - c0, to full relative precision in the dense limit
  double rapidity;   ///< atanh c0, which adds to phi
  double slope;      ///< d(rapidity) / d(psi)
  double log_slope;  ///< d(ln c0) / d(psi)
};

/// For psi > 0; \throws InputError otherwise.
Sound sound(double psi);

/// lambda_- and lambda_+ = (U -+ c0) / (1 -+ U c0). The empty state carries its own edge: both are U.
struct Speeds {
  double minus;
  double plus;
};
Speeds characteristic_speeds(const State& state);

/// The Riemann invariants phi - psi and phi + psi.
struct Invariants {
  double minus;
  double plus;
};
inline Invariants riemann_invariants(const State& state) { return {state.phi - state.psi, state.phi + state.psi}; }

/// Densities (k, P) or their fluxes (U k, Q).
struct Pair {
  double number;
  double momentum;
};

/// k and P. Zero for the empty state.
Pair density(const State& state);

/// Fluxes W = U k of k, and Q = U P + p of P. Zero for the empty state. |phi| < 350, psi < 350.
Pair flux(const State& state);

/// Spacing and momentum of one dislocation.
struct LagrangianState {
  double spacing;   ///< l = 2 pi / k = 2 K / (cosh phi cosh psi)
  double momentum;  ///< M = 2 pi P / k = 8 sinh phi cosh psi E
};

/// For psi > 0. \throws InputError otherwise.
LagrangianState lagrangian_state(const State& state);

/// The state with this spacing (> 0, finite) and momentum (finite). It solves one monotone scalar equation,
/// l sqrt(cosh^2 psi + (M / 8 E)^2) = 2 K. A `psi_guess` > 0 near the solution saves iterations. At spacings l > 1400,
/// psi is too small for a double. Those give the empty state with the velocity of the momentum. \throws NumericsError
/// unless psi < 700.
State state_of(const LagrangianState& train, double psi_guess);

/// The state, with other quantities that the solution yields.
struct SolvedState {
  State state;
  double sound_speed;  ///< c0, 0 if empty
  double EK;           ///< E K; the closures of viscous friction differ by the factor 4 E K / pi^2
};
SolvedState solve_state(const LagrangianState& train, double psi_guess);

/// Relative excess of the mass of a dislocation in a train over that of an isolated one, cosh(psi) E - 1, without
/// cancellation.
double mass_excess(double psi);

/// Energy of a dislocation in a train at rest, less the energy 8 of an isolated one.
double interaction_energy(double psi);

/// Energy of a dislocation, less that of one at rest in a train of the same spacing. It is never negative, and has full
/// relative precision for slow trains too.
double kinetic_energy(const State& state);

}  // namespace slipfront::modulation
