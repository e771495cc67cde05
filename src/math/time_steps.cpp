#include "math/time_steps.hpp"

#include <algorithm>
#include <string>

#include "math/digits.hpp"

namespace slipfront {

StepBudget::StepBudget(double expected, double end)
    : expected_(expected), end_(end), most_(std::max(always_allowed, most_times_expected * expected)) {}

NumericsError StepBudget::error(double time, long steps, const std::string& reason, const std::string& help) const {
  const std::string share = digits(100 * time / end_, 3);
  return NumericsError("t = " + digits(time) + ": given up after " + std::to_string(steps) + " steps, " + share +
                       " % of the run; about " + digits(expected_, 3) + " steps were expected for all of it. " +
                       reason + "; " + help);
}

}  // namespace slipfront
