#pragma once
/// \file
/// psi from what is observed: three monotone relations, solved to full relative precision over their whole range. The
/// fourth, psi of a stress at rest, is train::psi_of_stress.

namespace slipfront::rupture {

/// psi with c0(psi) = V, 0 < V < 1.
double psi_of_sound_speed(double V);

/// psi with psi + atanh c0(psi) = r, r > 0: the state where a ray crosses the fan of Eqs. 8-9.
double psi_of_fan(double r);

/// psi(0) of the pulse with slip velocity W(0) = pi sinh(phi0) cosh(psi0) / K = W, phi0 = atanh c0(psi0), W > 0.
double psi_of_origin_slip_velocity(double W);

}  // namespace slipfront::rupture
