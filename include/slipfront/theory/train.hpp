#pragma once
/// \file
/// The uniform train of dislocations: the two variables that determine it, its fields and averages over a period
/// (Eqs. 4-5), and the train at rest under a stress. All quantities are dimensionless: x in b/A, stress in mu A / pi,
/// slip velocity in c A / pi.

namespace slipfront {

/// A uniform train. Its dislocations move at U = tanh(phi), and sqrt(m1) = tanh(psi) measures their density. psi -> 0
/// is the empty interface, psi -> infinity the dense limit. The modulation equations (6) are diagonal in these
/// variables. Slow slip (psi ~ 1e-6 and far below) keeps full precision, because the elliptic parameter m itself is
/// never stored.
struct State {
  double phi = 0;  ///< rapidity of the dislocations
  double psi = 0;  ///< density variable; 0 means empty

  bool empty() const { return psi == 0; }
};

}  // namespace slipfront

namespace slipfront::train {

/// Displacement, stress and slip velocity at one point of a train.
struct Fields {
  /// Slip in b / (2 pi). It falls by 2 pi at each dislocation as x grows. The print of Eq. 4 lacks a factor 2.
  double u;
  double sigma;  ///< stress -u_x, in mu A / pi
  double w;      ///< slip velocity u_t = U sigma, in c A / pi
};

/// Fields at xi = x - U t, measured from the centre of a dislocation. \throws InputError for an empty state.
Fields fields(const State& state, double xi);

/// Length of one period, 2 pi / k. \throws InputError for an empty state.
double spacing(const State& state);

/// Averages over a period, with the densities and fluxes of the four conservation laws.
struct Averages {
  double k;              ///< Sigma = <sigma> = 2 pi N, N dislocations per unit length (Eq. 5)
  double W;              ///< <w> = U k (Eq. 5; the printed U N / 2 pi is a misprint)
  double sigma2;         ///< <sigma^2>
  double sigma3;         ///< <sigma^3>
  double one_minus_cos;  ///< <1 - cos u>
  double P;              ///< momentum density U <sigma^2>, also the energy flux
  double Q;              ///< momentum flux (1 + U^2)/2 <sigma^2> - <1 - cos u>
  double H;              ///< energy density (1 + U^2)/2 <sigma^2> + <1 - cos u>
  double I;              ///< wave action density P / k
  double J;              ///< wave action flux
};

/// <1 - cos u>, which does not depend on phi; 0 for the empty state.
double one_minus_cos(double psi);

/// All averages, each to a few ulp. For the empty state all are zero except J, whose limit is 4 cosh(phi) / pi.
Averages averages(const State& state);

/// The averages where the relative contact ratio is `contact` = a (docs/theory/6_contact.md: a^2 sin u in Eq. 3). They
/// are in the units of the interface; averages(state) would be in the local units a x and a t.
Averages averages(const State& state, double contact);

/// The smallest stress above 0 of a state in doubles. At smaller stresses psi = 4 exp(-pi / stress) underflows.
inline constexpr double smallest_stress = 0.0045;

/// Stress of a train at rest, pi cosh(psi) / K: the initial state of a rupture. \throws InputError unless psi > 0.
double stress_at_rest(double psi);

/// psi with pi cosh(psi) / K = stress, stress > 0, to full relative precision: the inverse of stress_at_rest.
double psi_of_stress(double stress);

/// The interface at rest under this stress >= 0. It is empty if the stress is 0.
inline State at_rest(double stress) { return stress > 0 ? State{0, psi_of_stress(stress)} : State{}; }

}  // namespace slipfront::train
