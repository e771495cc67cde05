#pragma once
/// \file
/// The ratio of the slip velocity W with viscous friction to W(0) without friction, as a function of Sigma- and the
/// damping number Gamma = C T. It comes from a table made with the pulse solver (docs/friction_ratio.md), for a true
/// step of stress into the empty interface. `damping_number` is the inverse, like a ruler on Fig. 10 of the paper.
/// The front that an observer sees, and the stress drop, of a pulse with viscous friction. Both depend on Sigma- and
/// the damping number Gamma = C T only, and come from a table made with the pulse solver (docs/friction_ratio.md), for
/// a true step of stress into the empty interface.

#include <array>
#include <string_view>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction_ratio {

/// Which slip velocity of the pulse.
enum class SlipVelocityKind {
  origin,     ///< W(0) at time T; x = 0 is the position of the initial step of stress
  mean,       ///< at time T, weighted with slip: integral of W slip dx over integral of slip dx
  peak,       ///< at time T, the largest W(x) up to the top that is reached uphill from x = 0
  time_mean,  ///< slip over duration: (1 / T) integral of W(0) dt from 0 to T
};
inline constexpr SlipVelocityKind all_slip_velocity_kinds[] = {SlipVelocityKind::origin, SlipVelocityKind::mean,
                                                               SlipVelocityKind::peak, SlipVelocityKind::time_mean};

/// "origin", "mean", "peak" or "time-mean". \throws InputError (with `key`) for any other name.
const char* name_of(SlipVelocityKind measure);
SlipVelocityKind measure_named(std::string_view name, std::string_view key = {});

struct Ratio {
  double value;       ///< W / frictionless W(0); for `origin` and `time_mean` 1 at Gamma = 0
  double by_damping;  ///< derivative of `value` with respect to Gamma
  double by_stress;   ///< derivative of `value` with respect to Sigma-
};

/// The ratio for `stress` = Sigma- in 0.05 ... 3 and `damping_number` >= 0. Above 1e8 it is the diffusion limit, which
/// falls as Gamma^(-1/2). Relative error: see `uncertainty`. \throws InputError if an argument is out of range.
Ratio evaluate(SlipVelocityKind measure, friction::Closure closure, double stress, double damping_number);

/// Like evaluate(...).value, but faster, because it computes no derivatives.
double evaluate_value(SlipVelocityKind measure, friction::Closure closure, double stress, double damping_number);

/// Relative error of the ratio: 1e-4, but 1e-2 for closure "paper" and 3 < Gamma < 1e5. That closure is unstable where
/// dislocations move faster than their own sound (docs/friction_ratio.md). Its slip velocities then do not converge
/// with the number of cells.
double uncertainty(friction::Closure closure, double damping_number);

/// The range of Sigma- that the table covers.
struct StressRange {
  double least, most;
};
StressRange stress_range();

struct Reading {
  double damping_number;  ///< Gamma = C T at which the table has the ratio
  double error;           ///< absolute error of the damping number, only from `uncertainty` of the table
};

/// The damping number for `stress` = Sigma- in 0.05 ... 3 and the `ratio` of W to the frictionless W(0). The ratio is
/// above 0 and at most that of `measure` without friction (1 for `origin` and `time_mean`). \throws InputError if an
/// argument is out of range.
Reading damping_number(SlipVelocityKind measure, friction::Closure closure, double stress, double ratio);

/// The ratio of a FrontCurve as a function of Sigma- at one damping number.
class FrontAtDamping {
 public:
  /// The ratio for `stress` = Sigma- in 0.05 ... 3. \throws InputError if it is out of range.
  Ratio operator()(double stress) const;

 private:
  friend class FrontCurve;
  double damping_ = 0;
  std::array<double, 9> value_{}, slope_{};  ///< coefficients of polynomials in Sigma-, and their slopes by Gamma
};

/// The observed trailing front at one threshold: |x_front(T)| / (|V-| T), which is at most 1. x_front is the farthest
/// x < 0 at which W reaches the threshold times the peak of W at time T (`SlipVelocityKind::peak`). Make one object and
/// call it many times: the constructor does the interpolation in the threshold.
class FrontCurve {
 public:
  /// Takes a `threshold` in 1e-4 ... 0.3. \throws InputError if it is out of range.
  FrontCurve(friction::Closure closure, double threshold);
  /// The ratio for `stress` = Sigma- in 0.05 ... 3 and `damping_number` >= 0. Above 1e8 it falls as Gamma^(-1/2).
  /// \throws InputError if an argument is out of range.
  Ratio operator()(double stress, double damping_number) const { return at_damping(damping_number)(stress); }
  /// The ratio at this damping number, for calls with many values of Sigma-.
  FrontAtDamping at_damping(double damping_number) const;

 private:
  std::vector<double> coefficients_;  ///< those of polynomials in Sigma- and Gamma
};

/// Makes a FrontCurve and calls it once.
Ratio front_ratio(friction::Closure closure, double stress, double damping_number, double threshold);

/// Relative error of the front ratio: 1e-3 for closure "consistent" and 5e-3 for "paper". For "paper" and
/// 3 < Gamma < 1e5, where it is unstable, it is 3e-2.
double front_uncertainty(friction::Closure closure, double damping_number);

/// The range of thresholds that the table covers.
struct ThresholdRange {
  double least, most;
};
ThresholdRange threshold_range();

/// Which static stress drop of the pulse at time T.
enum class Drop {
  origin,  ///< Sigma- - Sigma(0), at x = 0
  mean,    ///< weighted with slip over the stressed side: integral of (Sigma- - Sigma) slip dx / integral of slip dx
};

/// The stress drop over Sigma-, for the same arguments as FrontCurve. It is constant above a damping number of 1e8.
/// \throws InputError if an argument is out of range.
Ratio stress_drop_share(Drop drop, friction::Closure closure, double stress, double damping_number);

/// Relative error of the share: 1e-3, but 1e-2 for closure "paper" and 3 < Gamma < 1e5.
double stress_drop_uncertainty(friction::Closure closure, double damping_number);

}  // namespace slipfront::friction_ratio
