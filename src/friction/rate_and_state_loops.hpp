#pragma once

#include <cstddef>

/// Rate-and-state friction f = a asinh(w G), G = exp(base + share ln theta), at many places or in many trains at once,
/// as vector code chosen at run time.
namespace slipfront::friction {

struct RateAndStateRule {
  double a = 0;
  double base = 0;   ///< (f_0 + b ln(w_0 / D_c)) / a - ln(2 w_0)
  double share = 0;  ///< b / a
  double D = 0;      ///< D_c
};

/// f at each speed. Returns whether all were in the range of the vector code; others are those that are not
/// within_exponents.
bool forces(const RateAndStateRule& rule, std::size_t size, const double* speed, const double* theta, double* force);

bool within_exponents(const RateAndStateRule& rule, double theta);

/// Solves v + weight f(v) = free for each of at most 64 places; returns whether all are done. Places with done = 0 are
/// left to others: they have a G beyond what a double holds.
bool speeds_after(const RateAndStateRule& rule, std::size_t size, const double* free, double weight,
                  const double* theta, double* speed, double* done);

/// theta after a time at a constant velocity of either sign: ageing law; slip law.
void advance_ageing(const RateAndStateRule& rule, std::size_t size, const double* velocity, double time, double* theta);
/// `typical` may be `mean`.
void advance_by_slip(const RateAndStateRule& rule, std::size_t size, const double* mean, const double* typical,
                     double time, double* theta);

/// Means of f over slip in trains of these largest slip velocities and s = tanh psi, and what they change by with
/// ln(fastest); `slope` may be null.
void mean_forces(const RateAndStateRule& rule, std::size_t size, const double* fastest, const double* s,
                 const double* theta, double* mean, double* slope);

}  // namespace slipfront::friction
