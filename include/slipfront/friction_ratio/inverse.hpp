#pragma once
/// \file
/// The damping number from what friction leaves of the slip velocity: the table of `table.hpp` read the other way, as
/// with a ruler on the paper's Fig. 10.

#include "slipfront/friction_ratio/table.hpp"

namespace slipfront::friction_ratio {

struct Reading {
  double damping_number;  ///< Gamma = C T at which the table has the ratio
  double error;           ///< of the damping number, absolute, from `uncertainty` of the table alone
};

/// `stress` = Sigma- in 0.05 ... 3; `ratio` of W to the frictionless W(0), above 0 and at most what `measure` has
/// without friction (1 for `origin` and `time_mean`). \throws InputError.
Reading damping_number(Measure measure, friction::Closure closure, double stress, double ratio);

}  // namespace slipfront::friction_ratio
