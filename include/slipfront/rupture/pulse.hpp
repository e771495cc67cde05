#pragma once
/// \file
/// Profiles of the frictionless slip pulse over x/t (Eqs. 8-9): what Figs. 4-6 draw.

#include "slipfront/rupture/riemann.hpp"

namespace slipfront::rupture {

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
