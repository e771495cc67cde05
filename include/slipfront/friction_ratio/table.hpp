#pragma once
/// \file
/// The ratio of the slip velocity W with viscous friction to W(0) without friction, as a function of Sigma- and the
/// damping number Gamma = C T. It comes from a table made with the pulse solver (docs/friction_ratio.md), for a true
/// step of stress into the empty interface. `damping_number` is the inverse, like a ruler on Fig. 10 of the paper.

#include <string_view>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction_ratio {

/// Which slip velocity of the pulse.
enum class Measure {
  origin,     ///< W(0) at time T; x = 0 is the position of the initial step of stress
  mean,       ///< at time T, weighted with slip: integral of W slip dx over integral of slip dx
  peak,       ///< at time T, the largest W(x) up to the top that is reached uphill from x = 0
  time_mean,  ///< slip over duration: (1 / T) integral of W(0) dt from 0 to T
};
inline constexpr Measure all_measures[] = {Measure::origin, Measure::mean, Measure::peak, Measure::time_mean};

/// "origin", "mean", "peak" or "time-mean". \throws InputError (with `key`) for any other name.
const char* name_of(Measure measure);
Measure measure_named(std::string_view name, std::string_view key = {});

struct Ratio {
  double value;       ///< W / frictionless W(0); for `origin` and `time_mean` 1 at Gamma = 0
  double by_damping;  ///< derivative of `value` with respect to Gamma
  double by_stress;   ///< derivative of `value` with respect to Sigma-
};

/// The ratio for `stress` = Sigma- in 0.05 ... 3 and `damping_number` >= 0. Above 1e8 it is the diffusion limit, which
/// falls as Gamma^(-1/2). Relative error: see `uncertainty`. \throws InputError if an argument is out of range.
Ratio evaluate(Measure measure, friction::Closure closure, double stress, double damping_number);

/// Like evaluate(...).value, but faster, because it computes no derivatives.
double evaluate_value(Measure measure, friction::Closure closure, double stress, double damping_number);

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
Reading damping_number(Measure measure, friction::Closure closure, double stress, double ratio);

}  // namespace slipfront::friction_ratio
