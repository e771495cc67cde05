#pragma once
/// \file
/// Characteristic form of the modulation equations (6): phi +- psi travel at lambda_pm.

#include "slipfront/train/train.hpp"

namespace slipfront::modulation {

/// Speed of small changes of density in the frame of the train, c0 = tanh(psi) K / E, with what goes with it.
struct Sound {
  double c0;         ///< c0, 0 < c0 < 1
  double one_minus;  ///< 1 - c0, to full relative precision in the dense limit
  double rapidity;   ///< atanh c0, which adds to phi
  double slope;      ///< d(rapidity) / d(psi)
  double log_slope;  ///< d(ln c0) / d(psi)
};

/// For psi > 0; \throws InputError otherwise.
Sound sound(double psi);

/// lambda_- and lambda_+ = (U -+ c0) / (1 -+ U c0). The empty state carries its own edge: both are U.
struct Speeds {
  double minus;
  double plus;
};
Speeds characteristic_speeds(const State& state);

/// The Riemann invariants phi - psi and phi + psi.
struct Invariants {
  double minus;
  double plus;
};
inline Invariants riemann_invariants(const State& state) { return {state.phi - state.psi, state.phi + state.psi}; }

}  // namespace slipfront::modulation
