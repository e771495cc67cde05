#include "slipfront/setup/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "slipfront/pulse/run.hpp"
#include "slipfront/setup/pulse.hpp"

namespace slipfront::setup {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Given, or of the computation and not of the physics.
constexpr std::array<std::string_view, 6> without_error{"friction_coefficient", "damping_number", "time",
                                                        "conservation_error",   "solve_seconds",  "wall_seconds"};
constexpr std::array<std::string_view, 4> asked_of{"slip_velocity_at_origin", "stress_at_origin", "slip_at_origin",
                                                   "peak_slip_velocity"};

template <class Keys>
bool among(const Keys& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

double real(const Value& value) {
  const double* number = std::get_if<double>(&value);
  return number ? *number : none;
}

}  // namespace

std::vector<SummaryValue> pulse_summary_with(const scenario::Scenario& scenario, int cells,
                                             const std::function<bool()>& interrupted) {
  scenario::Scenario other = scenario;
  other.pulse.cells = cells;
  other.output.times.clear();
  other.output.every.reset();
  const pulse::Problem problem = pulse_problem(other);
  pulse::Run run(problem, pulse_schedule(other, problem));
  if (!run.go(interrupted)) return {};
  return summary(pulse_summary(), {other, run, 0});
}

std::vector<double> differences(const std::vector<SummaryValue>& fine, const std::vector<SummaryValue>& coarse) {
  std::vector<double> errors(fine.size(), none);
  for (std::size_t i = 0; i < std::min(fine.size(), coarse.size()); ++i)
    if (!among(without_error, fine[i].key)) errors[i] = std::fabs(real(fine[i].value) - real(coarse[i].value));
  return errors;
}

double largest_relative(const std::vector<SummaryValue>& fine, const std::vector<double>& errors) {
  double stress = 0, largest = 0;
  for (const SummaryValue& row : fine)
    if (std::string_view(row.key) == "stress_at_origin") stress = std::fabs(real(row.value));
  for (std::size_t i = 0; i < fine.size(); ++i)
    if (among(asked_of, fine[i].key) && std::isfinite(errors[i]))
      largest = std::fmax(largest, errors[i] / std::fmax(std::fabs(real(fine[i].value)), 1e-3 * stress));
  return largest;
}

}  // namespace slipfront::setup
