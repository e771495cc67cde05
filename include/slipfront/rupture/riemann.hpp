#pragma once
/// \file
/// The exact Riemann problem of the modulation equations, by the jump conditions of (k, P): two uniform trains meet at
/// x = 0. Every scheme is tested against it. The slip pulse of Eqs. 8-9 is its special case with an empty right side;
/// Figs. 4-6 draw its profiles over x/t.

#include "slipfront/train/train.hpp"

namespace slipfront::rupture {

/// A wave between two states. In a fan the solution depends on x/t between head and tail; a shock has head == tail.
struct Wave {
  enum class Kind { none, fan, shock };
  Kind kind = Kind::none;
  double outer = 0;  ///< x/t of its edge on the side of the given state
  double inner = 0;  ///< x/t of its edge on the side of the star state
};

/// The solution for all x/t.
struct RiemannSolution {
  State left, right;
  State star;  ///< uniform state between the waves; empty when the trains part or either side is empty
  Wave left_wave, right_wave;
};

/// Solves for any left and right states, empty ones included (psi = 0: no dislocations; its phi is ignored).
/// \throws InputError unless 0 <= psi <= 300 (stresses of up to 2e130, whose squares a double holds) and |phi| <= 18
/// (where U = tanh(phi) differs from 1). Relative error of the star state: 1e-8 at |phi| = 18 on both sides, where the
/// momentum of two trains that collide cancels; 1e-12 below |phi| = 5.
RiemannSolution solve_riemann(const State& left, const State& right);

/// x/t of the left and right edge of what moves: of the outermost waves, or of the last dislocation where a side is
/// empty.
struct Edges {
  double left, right;
};
Edges edges_of(const RiemannSolution& solution);

/// State at x/t.
State sample(const RiemannSolution& solution, double x_over_t);

/// The pulse from a step of stress `Sigma- = stress` into an empty interface: a fan from the trailing edge at
/// left_wave.outer = V- to the leading edge at left_wave.inner = V+. Take its states with sample(pulse, x/t).
/// \throws InputError as from_stress.
RiemannSolution slip_pulse(double stress);

/// Averages at one x/t.
struct ProfilePoint {
  double U;      ///< velocity of the dislocations, 0 where there are none
  double Sigma;  ///< stress
  double W;      ///< slip velocity
  double P;      ///< momentum density
};
ProfilePoint profile_point(const RiemannSolution& pulse, double x_over_t);

}  // namespace slipfront::rupture
