#pragma once
/// \file
/// The train at rest under a stress: the initial state of a rupture.

#include "slipfront/train/state.hpp"

namespace slipfront::train {

/// psi with pi cosh(psi) / K = stress, stress > 0, to full relative precision: the inverse of stress_at_rest.
double psi_of_stress(double stress);

/// The interface at rest under this stress, >= 0; without stress it is empty.
inline State at_rest(double stress) { return stress > 0 ? State{0, psi_of_stress(stress)} : State{}; }

}  // namespace slipfront::train
