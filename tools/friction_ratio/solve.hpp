#pragma once
/// \file
/// Slip velocity of a pulse with viscous friction, computed by the pulse solver. The table of
/// `friction_ratio/table.hpp` is generated from these values and checked against them. The initial stress is a true
/// step, from Sigma- to the empty interface.

#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction_ratio {

/// Slip velocities in c A / pi at the time T at which the damping number C T has the requested value.
struct SlipVelocities {
  double origin;     ///< W(0)
  double mean;       ///< integral of W slip dx over integral of slip dx
  double peak;       ///< largest W(x) up to the maximum that is reached uphill from x = 0
  double time_mean;  ///< slip at x = 0 over T, from the number of dislocations that have passed
};

struct Question {
  double stress = 0;          ///< Sigma-, in mu A / pi
  double damping_number = 0;  ///< Gamma = C T, f = C w
  friction::Closure closure = friction::Closure::consistent;
  int cells = 400;
};

/// W and slip at x.
struct Point {
  double x, W, slip;
};

/// The pulse at T = 1, from the last position at rest on the stressed side to the leading edge.
struct Pulse {
  std::vector<Point> points;  ///< centres and faces of the cells, in ascending order
  double stress_at_origin;    ///< Sigma(0)
  double slip_at_origin;
};

/// \throws InputError, NumericsError as the solver does.
SlipVelocities solve(const Question& question);

/// Like `solve`, but for each of `damping_numbers`, which must be > 0 and ascending. One run to the last of them gives
/// all results.
std::vector<SlipVelocities> solve_each(double stress, friction::Closure closure, int cells,
                                       const std::vector<double>& damping_numbers);

/// \throws InputError, NumericsError as the solver does.
Pulse solve_pulse(const Question& question);

/// The largest W up to the maximum that is reached uphill from x = 0.
double peak_of(const std::vector<Point>& points);

}  // namespace slipfront::friction_ratio
