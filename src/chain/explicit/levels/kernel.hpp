#pragma once

#include <cstddef>

#include "chain/model/periodic_force.hpp"

/// The loops over sites where a chain spends its time, as vector code chosen at run time (AVX-512, AVX2 or plain).
/// Every site is computed by the same operations wherever it falls in a vector, so that tilings and threads change no
/// bits.
namespace slipfront::chain {

/// One level, z -> z at the next, in two loops:
///     S = f(z)    y = z - coupled S    next = keep z - force S - before z_old    next += spread (y_left + y_right)
struct LevelRule {
  PeriodicForce f;
  double coupled = 0, keep = 0, force = 0, before = 0, spread = 0;
};

inline constexpr std::size_t lanes = 8;  ///< ranges are multiples of it, arrays aligned to as many doubles

/// First loop over [begin, end). `old`, the level before, may be `next`.
void local_part(const LevelRule& rule, const double* now, const double* old, double* next, double* y, std::size_t begin,
                std::size_t end);
/// The same where the substrate is a(x)^2 as strong: S = a2 sin u with z = u + eps S, u by Newton's method.
void local_part_with_contact(const LevelRule& rule, const PeriodicForce& sine, double eps, const double* a2,
                             const double* now, const double* old, double* next, double* y, std::size_t begin,
                             std::size_t end);
/// u and S from z; a2 may be null (1 everywhere).
void displacements(const PeriodicForce& sine, double eps, const double* a2, const double* z, double* u, double* S,
                   std::size_t size);
/// u alone where the substrate is 1 and f the polynomial of its force seen from z: u = z - eps f(z).
void displacements(const PeriodicForce& f, double eps, const double* z, double* u, std::size_t size);

/// Second loop; reads y from begin - 1 to end.
void add_neighbours(double spread, const double* y, double* next, std::size_t begin, std::size_t end);

/// next += what a force F adds to z at the next level, shared among the five points of the diamond.
struct DriveRule {
  double next = 0, before = 0, now = 0, neighbour = 0;  ///< in turns
};
void add_drive(const DriveRule& rule, const double* F_before, const double* F_now, const double* F_next, double* next,
               std::size_t size);
/// Shortens each step from `now` to `next` by `most`, to none where it is less: Coulomb friction, which stops a site
/// but does not throw it back. NaN stays NaN.
void shorten_steps(double most, const double* now, double* next, std::size_t size);

/// |next - from| times `per_step` as `free`, 0 for steps that are roundings of z (or of a thousandth of a turn, ahead
/// of fronts where z is smaller); returns whether any is not 0.
bool free_speeds(double per_step, const double* from, const double* next, double* free, std::size_t size);
/// Puts next where friction leaves `speed` of the free speeds; `force`, unless null, gets what it took of them times
/// `per_weight`, with the sign of the step. NaN stays NaN.
void take_speeds(double per_step, double per_weight, const double* from, const double* free, const double* speed,
                 double* next, double* force, std::size_t size);
/// (next - now) times `per_step`.
void velocities(double per_step, const double* now, const double* next, double* velocity, std::size_t size);
/// Sum of products, in an order that depends on `size` alone.
double sum_of_products(const double* a, const double* b, std::size_t size);

/// Steps of the displacement in radians, D = u_next - u and B the second difference of z over levels; u becomes u_next,
/// which is given, or z - eps f(z) at the next level.
void take_steps(const double* before, const double* now, const double* next, const double* u_next, double* u, double* D,
                double* B, std::size_t size);
void take_steps(const PeriodicForce& f, double eps, const double* before, const double* now, const double* next,
                double* u, double* D, double* B, std::size_t size);
/// Sums over sites of the work done in a step (WorkMeter), without spacing and strength: of a force, of viscous and of
/// Coulomb friction. The order depends on `size` alone.
double work_of_force(const double* F_before, const double* F_now, const double* F_next, const double* D,
                     const double* B, std::size_t size);
double work_of_viscous_friction(const double* D, const double* B, std::size_t size);
/// Energy that contacts give to the substrate as a^2 goes from a2 to a2_next, where u (in turns) comes to `u` by D.
double energy_of_contacts(const PeriodicForce& sine, const double* a2, const double* a2_next, const double* u,
                          const double* D, std::size_t size);
double work_of_coulomb_friction(const double* D, std::size_t size);

/// Whether all |z| are small enough for the range reduction (false for NaN).
bool bounded(const double* z, std::size_t size);

}  // namespace slipfront::chain
