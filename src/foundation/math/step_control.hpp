#pragma once
/// \file
/// The one loop that chooses the length of an adaptive time step, for all integrators.

#include <algorithm>
#include <cmath>

namespace slipfront {

/// Result of one attempt at a time step. An integrator reports its error estimate, and whether it found a result at
/// all.
struct StepAttempt {
  bool succeeded = false;
  double error = 0;      ///< in units of the tolerance
  bool resolved = true;  ///< false: the step changed more than its error estimate can see
};

/// How the length of a step follows the error of the last attempt, which is of the order dt^order.
struct StepControl {
  double order;
  double safety = 0.9;
  double most_growth = 4;        ///< after an accepted step
  double least_reduction = 0.9;  ///< factors of a step that is repeated because of its error
  double most_reduction = 0.2;
  double unresolved_factor = 0.5;  ///< upper limit of the factor where an attempt is not resolved
  double failure_factor = 0.5;     ///< factor after an attempt without a result

  bool accepts(const StepAttempt& attempt) const { return attempt.succeeded && attempt.error <= 1 && attempt.resolved; }
  /// Factor from an accepted step to the next one.
  double growth(double error) const { return std::fmin(by_error(error), most_growth); }
  /// Factor from a rejected attempt to the next one.
  double reduction(const StepAttempt& attempt) const {
    if (!attempt.succeeded) return failure_factor;
    const double factor = std::clamp(by_error(attempt.error), most_reduction, least_reduction);
    return attempt.resolved ? factor : std::fmin(factor, unresolved_factor);
  }

 private:
  double by_error(double error) const { return safety * std::pow(error, -1 / order); }
};

struct StepTaken {
  double length = 0;  ///< 0: the step was given up
  double next = 0;    ///< longest length that the error recommends for the next step
};

/// Calls attempt(length) with shorter and shorter lengths, beginning with `length`, until the control accepts one.
/// After each rejected attempt, gives_up(length, attempts so far) may throw, or return true to end without a step.
template <class Attempt, class GivesUp>
StepTaken take_step(const StepControl& control, double length, Attempt&& attempt, GivesUp&& gives_up) {
  for (int attempts = 1;; ++attempts) {
    const StepAttempt made = attempt(length);
    if (control.accepts(made)) return {length, length * control.growth(made.error)};
    if (gives_up(length, attempts)) return {};
    length *= control.reduction(made);
  }
}

/// Length of the next step where `length` is wanted and `remaining` is left to a time on which a step has to end: the
/// last two steps share what remains, so that none is much shorter than the others.
inline double step_within(double remaining, double length) {
  return length >= remaining ? remaining : length > remaining / 2 ? remaining / 2 : length;
}

}  // namespace slipfront
