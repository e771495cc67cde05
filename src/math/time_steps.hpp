#pragma once
/// \file
/// Time steps of all integrators: the one loop that chooses the length of an adaptive step, and how many steps a run
/// may take.

#include <algorithm>
#include <cmath>
#include <string>

#include "slipfront/error.hpp"

namespace slipfront {

/// SSPRK(3,3), the explicit integrator of third order that preserves strong stability up to one Euler step (Shu & Osher
/// 1988, J. Comput. Phys. 77:439). Each stage sets y to of_old y_old + (1 - of_old) (y + step rates(t, y)), where y_old
/// is the start of the step. Calls stage(t, step, of_old) for each.
template <class Stage>
void ssprk3(double t, double step, const Stage& stage) {
  stage(t, step, 0.0);
  stage(t + step, step, 0.75);
  stage(t + step / 2, step, 1.0 / 3);
}

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

/// The number of steps after which a run is given up, as a multiple of the number that is expected. It counts steps and
/// not seconds, so that no result depends on the speed of the machine.
class StepBudget {
 public:
  static constexpr double most_times_expected = 30;
  static constexpr double always_allowed = 2e4;  ///< steps that any run may take

  /// \param expected steps of the whole run, estimated before the first one
  /// \param end time of the end of the run
  StepBudget(double expected, double end);

  double expected() const { return expected_; }
  double most() const { return most_; }
  bool exhausted(long steps) const { return static_cast<double>(steps) > most_; }
  /// An error that states how far the run has come.
  /// \param reason why the steps are short and where, as a sentence without a full stop
  /// \param help what the user can do
  NumericsError error(double time, long steps, const std::string& reason, const std::string& help) const;

 private:
  double expected_, end_, most_;
};

}  // namespace slipfront
