#pragma once
/// \file
/// Slip velocity of one pulse with viscous friction, from the pulse solver: what the table of
/// `friction_ratio/table.hpp` is made from and checked against. True step of stress, from Sigma- into the empty
/// interface.

#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction_ratio {

/// Slip velocities in c A / pi, at the time T where the damping number C T is the one that was asked for.
struct SlipVelocities {
  double origin;     ///< W(0)
  double mean;       ///< integral of W slip dx over integral of slip dx
  double peak;       ///< the largest W(x) up to the top that is reached uphill from x = 0
  double time_mean;  ///< slip at x = 0 over T, by the dislocations that have passed
};

struct Question {
  double stress = 0;          ///< Sigma-, in mu A / pi
  double damping_number = 0;  ///< Gamma = C T, f = C w
  friction::Closure closure = friction::Closure::consistent;
  int cells = 400;
};

/// \throws InputError, NumericsError as the solver does.
SlipVelocities solve(const Question& question);

/// The same at each of `damping_numbers`, ascending and > 0, in one run to the last of them.
std::vector<SlipVelocities> solve_each(double stress, friction::Closure closure, int cells,
                                       const std::vector<double>& damping_numbers);

}  // namespace slipfront::friction_ratio
