#pragma once
/// \file
/// Computes psi from an observed quantity. The three relations are monotone, and are solved to full relative precision
/// over their whole range. A fourth function, train::psi_of_stress, computes psi from a stress at rest.

#include "slipfront/theory/train.hpp"

namespace slipfront::rupture {

/// psi with c0(psi) = V, 0 < V < 1.
double psi_of_sound_speed(double V);

/// psi with psi + atanh c0(psi) = r, r > 0. It is the state on a ray through the fan of Eqs. 8-9.
double psi_of_fan(double r);

/// The state at x/t in the fan of the lower edge, phi - psi, where phi + psi = upper_edge. There
/// x/t = tanh(phi - atanh c0), so psi + atanh c0 = upper_edge - atanh(x/t).
State state_in_left_fan(double upper_edge, double x_over_t);

/// psi at x = 0 of the pulse with slip velocity W > 0 there. It solves pi sinh(phi0) cosh(psi0) / K = W with
/// phi0 = atanh c0(psi0).
double psi_of_origin_slip_velocity(double W);

}  // namespace slipfront::rupture
