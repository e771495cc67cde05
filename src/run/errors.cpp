#include "slipfront/run/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "../digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/setup/pulse.hpp"

namespace slipfront::run {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Given, or of the computation and not of the physics.
constexpr std::array<std::string_view, 6> without_error{"friction_coefficient", "damping_number", "time",
                                                        "conservation_error",   "solve_seconds",  "wall_seconds"};
constexpr double coarser = 4;  ///< tolerance of the steps of a run with half the cells, for their error is one too
constexpr int fewest_cells = 4, most_cells = 25600;

/// Rows that a tolerance holds for.
constexpr std::array<std::string_view, 4> held_to_tolerance{"slip_velocity_at_origin", "stress_at_origin",
                                                            "slip_at_origin", "peak_slip_velocity"};

template <class Keys>
bool among(const Keys& keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

double real(const Value& value) {
  const double* number = std::get_if<double>(&value);
  return number ? *number : none;
}

/// The summary of a run of `cells` cells to the end, with coarser steps and no outputs on the way; empty if
/// `interrupted` said so.
std::vector<SummaryValue> summary_with(int cells, const scenario::Scenario& scenario,
                                       const std::function<bool()>& interrupted) {
  scenario::Scenario other = scenario;
  other.pulse.cells = cells;
  other.output.times.clear();
  other.output.every.reset();
  pulse::Problem problem = setup::pulse_problem(other);
  problem.tolerance = std::fmin(coarser * problem.tolerance, 0.1);
  problem.explicit_tolerance *= coarser;
  problem.longest_step *= 2;
  pulse::Run run(problem, setup::pulse_schedule(other, problem));
  try {
    if (!run.go(interrupted)) return {};
  } catch (const NumericsError&) {
    if (!run.finished()) throw;  // it has reached the end and is too coarse: so much the larger are the errors
  }
  return summary(pulse_summary(), {other, run, 0});
}

std::vector<double> differences(const std::vector<SummaryValue>& fine, const std::vector<SummaryValue>& coarse) {
  std::vector<double> errors(fine.size(), none);
  for (std::size_t i = 0; i < std::min(fine.size(), coarse.size()); ++i)
    if (!among(without_error, fine[i].key)) errors[i] = std::fabs(real(fine[i].value) - real(coarse[i].value));
  return errors;
}

/// The largest of `errors` over the size of what it belongs to. Sizes are at least a thousandth of the stress at x = 0.
double largest_relative(const std::vector<SummaryValue>& fine, const std::vector<double>& errors) {
  double stress = 0, largest = 0;
  for (const SummaryValue& row : fine)
    if (std::string_view(row.key) == "stress_at_origin") stress = std::fabs(real(row.value));
  for (std::size_t i = 0; i < fine.size(); ++i)
    if (among(held_to_tolerance, fine[i].key) && std::isfinite(errors[i]))
      largest = std::fmax(largest, errors[i] / std::fmax(std::fabs(real(fine[i].value)), 1e-3 * stress));
  return largest;
}

}  // namespace

std::vector<double> errors_of(const Result<pulse::Run>& fine, const scenario::Scenario& scenario,
                              const std::function<bool()>& interrupted) {
  std::vector<SummaryValue> coarse;
  try {
    const int half = scenario.pulse.cells / 2;
    if (half >= fewest_cells) coarse = summary_with(half, scenario, interrupted);
  } catch (const InputError&) {
  } catch (const NumericsError&) {  // then the errors are not known
  }
  std::vector<double> errors = differences(fine.summary, coarse);
  if (const auto slip = fine.run->slip_twice())
    for (std::size_t i = 0; i < errors.size(); ++i)
      if (std::string_view(fine.summary[i].key) == "slip_at_origin")
        errors[i] = std::fmax(errors[i], slip->beyond_sampling());
  return errors;
}

int cells_for(double tolerance, bool resumed, const scenario::Scenario& scenario,
              const std::function<bool()>& interrupted) {
  if (!(tolerance >= 1e-9 && tolerance <= 1))
    throw InputError(
        {.key = "tolerance", .value = digits(tolerance), .problem = "out of range", .allowed = "1e-9 to 1"});
  if (resumed)
    throw InputError({.key = "tolerance",
                      .problem = "chooses the cells of a run that has begun",
                      .allowed = "tolerance without resume"});
  const int given = scenario.pulse.cells;
  std::vector<SummaryValue> coarse = summary_with(std::max(given / 2, fewest_cells), scenario, interrupted);
  double reached = 0;
  for (int cells = given; cells <= most_cells && !coarse.empty(); cells *= 2) {
    std::vector<SummaryValue> fine = summary_with(cells, scenario, interrupted);
    if (fine.empty()) return given;
    reached = largest_relative(fine, differences(fine, coarse));
    if (reached <= tolerance) return cells;
    coarse = std::move(fine);
  }
  if (coarse.empty()) return given;
  throw NumericsError("tolerance " + digits(tolerance, 3) + " is not reached with " + std::to_string(most_cells) +
                      " cells: " + digits(reached, 3) + " is");
}

}  // namespace slipfront::run
