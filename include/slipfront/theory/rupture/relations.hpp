#pragma once
/// \file
/// The frictionless slip pulse from a step of stress into an empty interface (Eqs. 8-10). Stress, rupture velocity or
/// slip velocity determines all other quantities. Velocities are in units of c, stress in mu A / pi, slip velocity in
/// c A / pi.

#include <span>

#include "slipfront/description.hpp"

namespace slipfront::rupture {

/// One pulse. Speeds are positive; the origin x = 0 is the position of the initial step of stress.
struct Relations {
  double stress;                          ///< Sigma-, stress before the rupture
  double rupture_velocity;                ///< |V-|, fast front, into the stressed side
  double leading_velocity;                ///< V+ = tanh(psi-), slow front, into the empty side
  double velocity_ratio;                  ///< |V- / V+| = K / E
  double slip_velocity;                   ///< W(0)
  double stress_at_origin;                ///< Sigma(0)
  double dislocation_velocity_at_origin;  ///< U(0)
  double psi;                             ///< psi-, state of the stressed side
  double psi_at_origin;                   ///< psi(0)
};

/// Closed forms (8)-(10) in (phi, psi). The error of every output is a few ulp times the conditioning of the problem,
/// which is pi / Sigma for a small stress and 1 / (1 - V) for a velocity near 1. The allowed range is that in which all
/// nine outputs are normal doubles: stress above about 0.00447, velocities above about 1e-302. \throws InputError (key,
/// value and allowed) outside that range.
Relations from_stress(double stress);
Relations from_rupture_velocity(double rupture_velocity);
Relations from_slip_velocity(double slip_velocity);
/// The pulse of the state psi- on the stressed side. It needs no root but psi(0).
Relations from_psi(double psi);

/// The nine members of Relations, with their descriptions, in the order of their declaration.
struct RelationsQuantity {
  Description about;
  double Relations::*value;
};
std::span<const RelationsQuantity> relations_quantities();

}  // namespace slipfront::rupture
