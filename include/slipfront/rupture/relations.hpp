#pragma once
/// \file
/// The frictionless slip pulse from a step of stress into an empty interface (Eqs. 8-10): any one of stress, rupture
/// velocity and slip velocity gives all the others. Velocities in c, stress in mu A / pi, slip velocity in c A / pi.

#include <span>

#include "slipfront/description.hpp"

namespace slipfront::rupture {

/// One pulse. Speeds are positive; "origin" is x = 0, where the step of stress was.
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

/// Closed forms (8)-(10) in (phi, psi): every output to a few ulp times the conditioning of the question, pi / Sigma
/// from a small stress, 1 / (1 - V) from a velocity near 1. The range is where all nine outputs are normal doubles:
/// stress above about 0.00447, velocities above about 1e-302. \throws InputError outside it, with key, value and what
/// is allowed.
Relations from_stress(double stress);
Relations from_rupture_velocity(double rupture_velocity);
Relations from_slip_velocity(double slip_velocity);

/// The nine members, named as they are, in their order.
struct RelationsQuantity {
  Description about;
  double Relations::*value;
};
std::span<const RelationsQuantity> relations_quantities();

}  // namespace slipfront::rupture
