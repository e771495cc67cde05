#pragma once
/// \file
/// The effect of the state theta of a position on its contacts and its pores (docs/friction.md, "Ageing contacts and
/// dilatancy").

#include <cstddef>

namespace slipfront::friction {

/// Contacts that strengthen with their age, and pores that widen where contacts are renewed:
///     a^2 -> a^2 (1 - p)^2 (1 + beta ln(1 + theta / theta_c)),    f -> (1 - p) f,
///     p_t = -(p - p_0) / t_p + E d/dt ln(theta),    E = epsilon / b_p,
/// pressures over the total normal stress (Segall & Rice 1995, J. Geophys. Res. 100:22155).
struct Contacts {
  double ageing = 0;     ///< beta >= 0
  double age = 0;        ///< theta_c, > 0 where contacts age
  double dilatancy = 0;  ///< E >= 0
  double drainage = 0;   ///< t_p > 0; 0: pores never drain
  double ambient = 0;    ///< p_0, 0 <= p_0 < 1

  bool act() const { return ageing > 0 || dilatancy > 0; }
  /// a^2 over that of contacts without age and pores without pressure. `excess` is p - p_0.
  double strength(double theta, double excess) const;
  /// 1 - p.
  double share(double excess) const { return 1 - (ambient + excess); }
  /// p - p_0 after a time in which the logarithm of theta changed evenly: exact then, for any t_p.
  double excess_after(double time, double excess, double theta_before, double theta) const;
  /// Both for many positions: `excess` becomes that after the time, `strength` what belongs to it and to theta.
  void advance(std::size_t size, double time, const double* theta_before, const double* theta, double* excess,
               double* strength) const;
};

}  // namespace slipfront::friction
