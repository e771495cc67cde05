#pragma once
/// \file
/// The effect of the state theta of a position on its contacts and its pores (docs/friction.md, "Ageing contacts and
/// dilatancy").

#include <cstddef>
#include <vector>

#include "math/simd/vector_code.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Calls `task` with the first position of each part, its size, and the first state variable there, which it changes.
template <class Task>
void change_in_parts(std::size_t size, EvolvingStates states, const Task& task) {
  double copies[part_size];
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    const EvolvingStates part = states.from(begin);
    double* const values = part.column(0, some, copies);
    task(begin, some, values);
    for (std::size_t i = 0; i < some && values == copies; ++i) part(i, 0) = values[i];
  });
}

/// The state theta of rate-and-state friction, the age of a position's contacts. Exact at a constant velocity.
///     ageing: theta_t = 1 - |w| theta / D_c            slip: theta_t = -x ln x, x = |w| theta / D_c
/// The ageing law is linear in w. Of the slip law the mean over time is -(W theta / D_c) (<ln w>_u + ln(theta / D_c)),
/// as W dt is du.
class ContactAge final : public StateEvolution {
 public:
  enum class Kind { ageing, slip };
  ContactAge(Kind kind, double start, double distance) : kind_(kind), start_(start), D_(distance) {}
  void start(std::span<double> theta) const override { theta[0] = start_; }
  void advance(const Slip& slip, double time, std::span<double> theta) const override;
  void advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates theta) const override;

 private:
  Kind kind_;
  double start_, D_;
};

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

/// Contacts and pores whose numbers vary, at many positions.
class VaryingContacts {
 public:
  bool empty() const { return ageing_.empty(); }
  void add(const Contacts& contacts);
  /// Contacts::advance for `size` positions from position `first` on.
  void advance(std::size_t first, std::size_t size, double time, const double* theta_before, const double* theta,
               double* excess, double* strength) const;
  double ambient(std::size_t i) const { return ambient_[i]; }

 private:
  std::vector<double> ageing_, per_age_, dilatancy_, per_drainage_, ambient_;
};

}  // namespace slipfront::friction
