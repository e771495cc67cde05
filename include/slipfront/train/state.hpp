#pragma once
/// \file
/// The two numbers that fix a uniform train of dislocations.

namespace slipfront {

/// A uniform train: dislocations move at U = tanh(phi); sqrt(m1) = tanh(psi) tells how densely they are packed. psi ->
/// 0 is the empty interface, psi -> infinity the dense limit. In these variables the modulation equations (6) are
/// diagonal, and slow slip (psi ~ 1e-6 and far below) loses no digits; the elliptic parameter m itself is never stored.
struct State {
  double phi = 0;  ///< rapidity of the dislocations
  double psi = 0;  ///< density variable; 0 means empty

  bool empty() const { return psi == 0; }
};

}  // namespace slipfront
