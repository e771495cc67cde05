#pragma once
/// \file
/// What viscous friction leaves of the slip velocity, W with friction over W(0) without, as a function of Sigma- and
/// the damping number Gamma = C T: a table made from the pulse solver (docs/friction_ratio.md), for a true step of
/// stress into the empty interface. `damping_number` reads it the other way, as with a ruler on the paper's Fig. 10.

#include <string_view>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction_ratio {

/// Which slip velocity of the pulse.
enum class Measure {
  origin,     ///< W(0) at time T, where the step of stress was
  mean,       ///< at time T, weighted with slip: integral of W slip dx over integral of slip dx
  peak,       ///< at time T, the largest W(x) up to the top that is reached uphill from x = 0
  time_mean,  ///< slip over duration: (1 / T) integral of W(0) dt from 0 to T
};
inline constexpr Measure all_measures[] = {Measure::origin, Measure::mean, Measure::peak, Measure::time_mean};

/// "origin", "mean", "peak" or "time-mean", and back. \throws InputError (with that key) for any other word.
const char* name_of(Measure measure);
Measure measure_named(std::string_view name, std::string_view key = {});

struct Ratio {
  double value;       ///< W / frictionless W(0); for `origin` and `time_mean` 1 at Gamma = 0
  double by_damping;  ///< its derivative d/dGamma
  double by_stress;   ///< and d/dSigma-
};

/// `stress` = Sigma- in 0.05 ... 3, `damping_number` >= 0; above 1e8 the diffusion limit, falling as Gamma^(-1/2).
/// Relative error: see `uncertainty`. \throws InputError.
Ratio evaluate(Measure measure, friction::Closure closure, double stress, double damping_number);

/// Relative error to allow for: 1e-4; closure "paper" 1e-2 for 3 < Gamma < 1e5. It is unstable where dislocations
/// outrun their own sound (docs/friction_ratio.md): there no number of cells settles its slip velocities.
double uncertainty(friction::Closure closure, double damping_number);

/// Sigma- for which there is a table.
struct StressRange {
  double least, most;
};
StressRange stress_range();

struct Reading {
  double damping_number;  ///< Gamma = C T at which the table has the ratio
  double error;           ///< of the damping number, absolute, from `uncertainty` of the table alone
};

/// `stress` = Sigma- in 0.05 ... 3; `ratio` of W to the frictionless W(0), above 0 and at most what `measure` has
/// without friction (1 for `origin` and `time_mean`). \throws InputError.
Reading damping_number(Measure measure, friction::Closure closure, double stress, double ratio);

}  // namespace slipfront::friction_ratio
