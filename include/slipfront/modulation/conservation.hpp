#pragma once
/// \file
/// The conservation laws behind Eqs. (6): dislocation number k and momentum P, the pair that holds across shocks too.

#include "slipfront/train/train.hpp"

namespace slipfront::modulation {

/// Densities (k, P) or their fluxes (U k, Q).
struct Pair {
  double number;
  double momentum;
};

/// k and P. Zero for the empty state.
Pair density(const State& state);

/// Fluxes W = U k of k, and Q = U P + p of P. Zero for the empty state. |phi| < 350, psi < 350.
Pair flux(const State& state);

}  // namespace slipfront::modulation
