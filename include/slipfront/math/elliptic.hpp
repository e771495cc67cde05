#pragma once
/// \file
/// Complete elliptic integrals of the parameter m = 1 - m1. The functions take m1 or a function of it, so that they
/// keep full precision where m is near 1.
/// Jacobi's amplitude and elliptic functions of the parameter m = 1 - m1. The functions take m1, so that they keep full
/// precision where m is near 1.

namespace slipfront::elliptic {

/// K(m) and E(m).
struct Complete {
  double K;
  double E;
};

/// K and E of the parameter m = 1 - m1, to 4 ulp for 1e-308 <= m1 <= 1. \throws InputError outside (0, 1].
Complete complete(double m1);

/// K, E and the differences that the modulation theory needs, at sqrt(m1) = tanh(psi). Each field has full relative
/// precision for every psi from the smallest normal double to 1e300, because no field is a difference of near numbers.
struct AtPsi {
  double K;
  double E;
  double s;         ///< tanh(psi) = sqrt(m1)
  double ratio;     ///< E/K
  double excess;    ///< E/K - sqrt(m1); falls as m^2 / 16 in the dense limit
  double deficit;   ///< 1 - E/K; falls as m / 2
  double above_m1;  ///< E/K - m1; falls as m / 2
  double E_rest;    ///< E - 1; falls as m1 ln(1/m1) / 4 in the empty limit
};

/// The fields of AtPsi for psi > 0. \throws InputError otherwise.
AtPsi at_psi(double psi);

/// d(ln K) / d(psi) = -(E/K - m1) / s.
inline double log_slope_of_K(const AtPsi& at) { return -at.above_m1 / at.s; }

/// The fields of AtPsi from the complementary modulus s = sqrt(m1) = tanh(psi). The caller ensures 0 < s <= 0.97, where
/// 1 - s is precise.
AtPsi at_modulus(double s);

/// Limit psi -> 0, the almost empty interface: K = ln(4/psi), E = 1. Exact to rounding for psi < 1e-9. No other formula
/// serves where m1 = psi^2 underflows.
AtPsi at_psi_empty(double psi);
inline constexpr double psi_empty_below = 1e-9;

/// Limit psi -> infinity, densely packed dislocations: m = 4 exp(-2 psi), K = E = pi/2. Exact to rounding for psi > 20.
AtPsi at_psi_dense(double psi);
inline constexpr double psi_dense_above = 20.0;

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
