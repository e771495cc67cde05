#pragma once
/// \file
/// How many time steps a run may take.

#include <string>

#include "slipfront/error.hpp"

namespace slipfront {

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
