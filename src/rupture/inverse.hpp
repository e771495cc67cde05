#pragma once
/// \file
/// Computes psi from an observed quantity. The three relations are monotone, and are solved to full relative precision
/// over their whole range. A fourth function, train::psi_of_stress, computes psi from a stress at rest.

namespace slipfront::rupture {

/// psi with c0(psi) = V, 0 < V < 1.
double psi_of_sound_speed(double V);

/// psi with psi + atanh c0(psi) = r, r > 0. It is the state on a ray through the fan of Eqs. 8-9.
double psi_of_fan(double r);

/// psi at x = 0 of the pulse with slip velocity W > 0 there. It solves pi sinh(phi0) cosh(psi0) / K = W with
/// phi0 = atanh c0(psi0).
double psi_of_origin_slip_velocity(double W);

}  // namespace slipfront::rupture
