#pragma once
/// \file
/// Converts the constants of rock and interface to those of the model (docs/theory/1_chain.md, Eqs. 1-3). All are in SI
/// units.

namespace slipfront::medium {

/// The elastic half-spaces and the asperities between them.
struct Interface {
  double shear_modulus = 0;     ///< mu, Pa, > 0
  double density = 0;           ///< rho, kg/m^3, > 0
  double poisson_ratio = 0;     ///< nu, -1 < nu < 0.5
  double asperity_spacing = 0;  ///< b, m, > 0
  double contact_ratio = 0;     ///< A, real to nominal contact area, 0 < A <= A_plastic
};

/// The two expressions for A in the paper. The paper derives the first and then rounds it to the second.
enum class ContactForm {
  derived,  ///< A = A_plastic Sigma_N / sigma_p
  rounded,  ///< A = Sigma_N / sigma_p
};

/// A_plastic = sqrt((1 - nu) / 2), the contact ratio at which the interface yields. \throws InputError for a bad nu.
double plastic_contact_ratio(double poisson_ratio);

/// A from the normal stress Sigma_N and the penetration hardness sigma_p (in the same unit, both > 0).
/// \throws InputError if an argument is out of range.
double contact_ratio(double normal_stress, double hardness, double poisson_ratio, ContactForm form);

/// Constants of the Frenkel-Kontorova chain, Eq. 1.
struct ChainConstants {
  double mass;             ///< M = rho b^3, kg
  double spring;           ///< K_b = 2 mu b / (1 - nu), N/m
  double substrate_force;  ///< F_d = (mu b^2 / 2 pi)(A / A_plastic)^2, N
  double speed;            ///< c = b sqrt(K_b / M), m/s
};
/// \throws InputError that names the constant out of its range.
ChainConstants chain_constants(const Interface& interface);

/// The speed c of Eq. 3, c^2 = 2 mu / (rho (1 - nu)), from the constants that are known. \throws InputError if an
/// argument is out of range.
double speed_from_shear_modulus(double shear_modulus, double density, double poisson_ratio);
double speed_from_p_wave(double p_wave_speed, double poisson_ratio);  ///< c = c_l sqrt(1 - 2 nu) / (1 - nu)
double speed_from_s_wave(double s_wave_speed, double poisson_ratio);  ///< c = c_s sqrt(2 / (1 - nu))

/// Poisson's ratio from the two wave speeds, for vp > 2 vs / sqrt(3). \throws InputError otherwise.
double poisson_ratio(double p_wave_speed, double s_wave_speed);

/// The unit of each dimensionless quantity. Dimensional = dimensionless * unit.
struct Units {
  double slip;           ///< b / (2 pi): u = 2 pi is one asperity spacing
  double length;         ///< b / A
  double time;           ///< b / (c A)
  double strain;         ///< A / (2 pi)
  double stress;         ///< mu A / pi, for sigma = -u_x
  double slip_velocity;  ///< c A / pi, for w = u_t: see face_factor
  double velocity;       ///< c, for U, V and x/t. The unit of F and f needs nu too: see traction_unit
};

/// The paper's unit of slip velocity, c A / pi, is twice the unit that follows from u_t (c A / 2 pi), because both
/// faces move. It is the default everywhere.
inline constexpr double face_factor = 2;

/// \throws InputError for constants out of range.
Units units(double shear_modulus, double speed, double contact_ratio, double asperity_spacing);

/// The units of stress and slip velocity. They do not need the asperity spacing, which is seldom known.
double stress_unit(double shear_modulus, double contact_ratio);
double slip_velocity_unit(double speed, double contact_ratio);

/// The unit of F and f in Eq. 3, as a traction on the nominal area, Pa: mu A^2 / (pi (1 - nu)). Eq. 3 is Eq. 1
/// divided by F_d. Thus F = 1 is the force F_d = mu b^2 A^2 / (pi (1 - nu)) on each asperity
/// (`ChainConstants::substrate_force`), and each area b^2 has one asperity. \throws InputError if an argument is out of
/// range.
double traction_unit(double shear_modulus, double poisson_ratio, double contact_ratio);

/// The unit of F and f that the paper prints, mu A / (2 pi), Pa. It is F_d over the real contact area A b^2, with
/// A_plastic rounded to 1. For a traction on the nominal area, such as the stress that loads a fault, Eq. 1 gives
/// another unit: at A = 0.003 and nu = 0.3 the printed one is 117 times too large. \throws InputError if an argument is
/// out of range.
double printed_traction_unit(double shear_modulus, double contact_ratio);

}  // namespace slipfront::medium
