#pragma once
/// \file
/// The solution of the Riemann problem of the modulation equations by the jump conditions of (k, P): two uniform trains
/// meet at x = 0, and one train is everywhere. Schemes for one train are tested against it. Without friction,
/// riemann_trains.hpp has the exact solution where dislocations overtake each other. The slip pulse of Eqs. 8-9 is the
/// special case with an empty right side; Figs. 4-6 show its profiles over x/t.

#include <span>
#include <string>
#include <string_view>

#include "slipfront/description.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::rupture {

/// The uniform train with this stress (mu A / pi) and this velocity U of its dislocations (c). Eq. 5 gives
/// Sigma = cosh(phi) Sigma_0(psi) and U = tanh(phi), where Sigma_0 is the stress of a train at rest. A stress of 0 is
/// the empty interface. Errors have the key `side` with _stress or _velocity behind it.
/// \throws InputError unless |U| is at most 0.999999, and the stress is 0 or at most 1e6 and Sigma_0 at least
/// train::smallest_stress.
State moving_train(double stress, double velocity, const std::string& side);

/// A wave between two states. In a fan the solution depends on x/t between head and tail; a shock has head == tail.
/// Only the solution of riemann_trains.hpp has two trains in a wave.
struct Wave {
  enum class Kind { none, fan, shock, two_trains };
  Kind kind = Kind::none;
  double outer = 0;  ///< x/t of the edge next to the given state
  double inner = 0;  ///< x/t of the edge next to the star state
};

/// "none", "fan", "shock" or "two-trains".
std::string_view name_of(Wave::Kind kind);

/// The solution for all x/t.
struct RiemannSolution {
  State left, right;
  State star;  ///< uniform state between the waves; empty if the trains separate or either side is empty
  Wave left_wave, right_wave;
};

/// Solves for any left and right states. An empty state (psi = 0) has no dislocations, and its phi is ignored.
/// The relative error of the star state is 1e-12 if |phi| < 5. It is 1e-8 if |phi| = 18 on both sides, where the
/// momenta of two colliding trains cancel. \throws InputError unless 0 <= psi <= 300 and |phi| <= 18. The bound of psi
/// allows stresses of up to 2e130, whose squares a double can represent. Up to that |phi|, U = tanh(phi) differs
/// from 1.
RiemannSolution solve_riemann(const State& left, const State& right);

/// x/t of the left and right edges of the moving region. An edge is that of the outermost wave, or the last dislocation
/// if that side is empty. If both trains are the same, they are the speeds at which a small disturbance would spread.
struct Edges {
  double left, right;
};
Edges edges_of(const RiemannSolution& solution);

/// State at x/t.
State sample(const RiemannSolution& solution, double x_over_t);

/// The pulse from a step of stress `Sigma- = stress` into an empty interface: a fan from the trailing edge at
/// left_wave.outer = V- to the leading edge at left_wave.inner = V+. sample(pulse, x/t) gives its states.
/// \throws InputError like from_stress.
RiemannSolution slip_pulse(double stress);

/// Averages over a train, or at one x/t.
struct ProfilePoint {
  double U;      ///< velocity of the dislocations, 0 where there are none
  double Sigma;  ///< stress
  double W;      ///< slip velocity
  double P;      ///< momentum density
};
ProfilePoint profile_point(const State& state);
ProfilePoint profile_point(const RiemannSolution& solution, double x_over_t);

/// The members of ProfilePoint, with their descriptions, in the order of their declaration.
struct ProfileQuantity {
  Description about;
  double ProfilePoint::*value;
};
std::span<const ProfileQuantity> profile_quantities();

}  // namespace slipfront::rupture
