#pragma once
/// \file
/// Jacobi's amplitude and elliptic functions of the parameter m = 1 - m1. The functions take m1, so that they keep full
/// precision where m is near 1.

#include "slipfront/elliptic/complete.hpp"

namespace slipfront::elliptic {

/// am(z), sn(z), cn(z), dn(z), and pi/2 - am(z), which keeps its precision where am(z) is near pi/2 (between two
/// kinks).
struct Jacobi {
  double am;
  double coamplitude;  ///< pi/2 - am
  double sn;
  double cn;
  double dn;
};

/// The functions at any finite z for 1e-308 <= m1 <= 1. Their relative error is a few ulp times the conditioning of
/// z mod 2K. This holds for dn and cn too where they are as small as sqrt(m1). \throws InputError outside.
Jacobi jacobi(double z, double m1);

/// Like jacobi(z, m1) with sqrt(m1) = tanh(psi), for any psi that at_psi accepts.
Jacobi jacobi(double z, const AtPsi& at);

}  // namespace slipfront::elliptic
