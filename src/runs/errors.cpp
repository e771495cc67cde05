#include "runs/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "averages/pulse/checks/checks.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/problem.hpp"

namespace slipfront::run {
namespace {

/// Safety factor if the values on three grids do not converge (Eca & Hoekstra, 2014, J. Comput. Phys.
/// 262:104).
constexpr double safety_unordered = 3;
/// Times the change, it is the error of the finest (Richardson) of values that converge.
constexpr double safety = 1.5;
constexpr int fewest_cells = 4, most_cells = 25600;
/// The largest product of steps and cells in a run that --tolerance makes: about a minute on one processor. Doubling
/// the cells also doubles the steps, so it costs four times as much.
constexpr double most_cost = 1e8, cost_of_doubling = 4;

/// Whether a tolerance applies to a row.
bool held_to_tolerance(const Row& row) {
  const ErrorRule rule = row.about.error;
  return rule == ErrorRule::stress || rule == ErrorRule::slip || rule == ErrorRule::slip_velocity ||
         rule == ErrorRule::peak;
}

/// Carries out a coarser run. Returns its summary, which is empty if `interrupted` returned true. `steps`, unless null,
/// gets their number.
std::vector<Row> summary_of(const Plan& plan, const std::function<bool()>& interrupted, int threads = 1,
                            long* steps = nullptr) {
  const Result result = begin(plan, {.threads = threads});
  try {
    if (!result.run->go(interrupted)) return {};
  } catch (const NumericsError&) {
    // A pulse that has reached its end is too coarse, which makes the errors larger.
    if (plan.is_on_plane() || !result.run->finished()) throw;
  }
  if (steps) *steps = result.run->steps();
  return result.numbers({});
}

/// The summary that `task` returns; empty if it fails. The effect of such a run on the errors is unknown.
template <class Task>
std::vector<Row> if_possible(const Task& task) {
  try {
    return task();
  } catch (const InputError&) {
    return {};
  } catch (const NumericsError&) {
    return {};
  }
}

/// The summary of the scenario with `cells` cells, tolerances that are `coarser` times larger, and no outputs before
/// the end. `cost`, unless null, gets steps times cells.
std::vector<Row> summary_with(int cells, const scenario::Scenario& scenario, const std::function<bool()>& interrupted,
                              double coarser = 4, double* cost = nullptr) {
  scenario::Scenario other = scenario;
  other.pulse.cells = cells;
  other.output.times.clear();
  other.output.every.reset();
  Plan plan = plan_of(scenario::SolverKind::pulse, std::move(other));
  plan.pulse.tolerance = std::fmin(coarser * plan.pulse.tolerance, 0.1);
  plan.pulse.explicit_tolerance *= coarser;
  plan.pulse.longest_step *= std::sqrt(coarser);
  long steps = 0;
  std::vector<Row> summary = summary_of(plan, interrupted, 1, &steps);
  if (cost && !summary.empty()) *cost = static_cast<double>(steps) * cells;
  return summary;
}

/// The larger of two changes of a value: at the last doubling of the cells, and half of the one before, as for a scheme
/// of first order.
double change_of(double fine, double half, double quarter) {
  return std::fmax(std::fabs(fine - half), std::fabs(half - quarter) / 2);
}

/// Estimates the error of `fine` from the values with half and a quarter of the cells. If `quarter` is NaN, the values
/// count as not converging. If `half` is NaN, so is the error. `factor` is the safety factor for values that converge.
double estimated(double fine, double half, double quarter, double factor) {
  const double last = fine - half, before = half - quarter;
  if (std::isnan(last)) return none;
  const bool converges = last * before >= 0 && std::fabs(last) <= std::fabs(before);
  if (converges) return factor * change_of(fine, half, quarter);
  return safety_unordered * std::fmax(std::fabs(last), std::isnan(before) ? 0 : std::fabs(before));
}

/// Estimates the errors of the finest of three runs from the changes at each doubling of the cells.
std::vector<double> estimated(const std::vector<Row>& fine, const std::vector<Row>& half,
                              const std::vector<Row>& quarter) {
  std::vector<double> errors(fine.size(), none);
  for (std::size_t i = 0; i < std::min(fine.size(), half.size()); ++i) {
    if (fine[i].about.error == ErrorRule::unknown) continue;
    // Cells lengthen the tail that an observer sees, by less than in proportion to their size. So we use the larger
    // factor.
    const double factor = fine[i].about.error == ErrorRule::observed_front ? safety_unordered : safety;
    const double coarsest = i < quarter.size() ? quarter[i].number() : none;
    errors[i] = estimated(fine[i].number(), half[i].number(), coarsest, factor);
  }
  return errors;
}

/// Whether each doubling of the cells more than doubles a value, as for a pulse that is narrower than a cell.
bool grows(double fine, double half, double quarter) {
  constexpr double rounding = 1e-14;
  return std::fabs(quarter) > rounding && half / quarter > 2 && fine / half > 2;
}

/// The row with a rule that no other row has.
std::size_t row_of(ErrorRule rule, const std::vector<Row>& rows) {
  const auto is_it = [rule](const Row& row) { return row.about.error == rule; };
  return static_cast<std::size_t>(std::find_if(rows.begin(), rows.end(), is_it) - rows.begin());
}

/// The largest relative error of the rows to which a tolerance applies. We divide by at least a thousandth of the
/// stress at x = 0.
double largest_relative(const std::vector<Row>& fine, const std::vector<double>& errors) {
  const double stress = std::fabs(fine[row_of(ErrorRule::stress, fine)].number());
  double largest = 0;
  for (std::size_t i = 0; i < fine.size(); ++i)
    if (held_to_tolerance(fine[i]) && std::isfinite(errors[i]))
      largest = std::fmax(largest, errors[i] / std::fmax(std::fabs(fine[i].number()), 1e-3 * stress));
  return largest;
}

/// Corrects the errors of the peak. Its slip velocity is known no better than that at x = 0. Its position may be that
/// of any cell that slips as fast within this error, also with the other sign.
void correct_peak(const pulse::Run& run, const std::vector<Row>& summary, std::vector<double>& errors) {
  const std::size_t height = row_of(ErrorRule::peak, summary), place = row_of(ErrorRule::peak_position, summary);
  const double at_origin = errors[row_of(ErrorRule::slip_velocity, summary)];
  const double peak = summary[height].number(), x = summary[place].number();
  const double error = errors[height] = std::isnan(errors[height]) ? none : std::fmax(errors[height], at_origin);
  if (!std::isfinite(error) || !std::isfinite(x)) return;
  const std::vector<double>&W = run.snapshots().back().profile.W, &edges = run.schedule().x_edges;
  for (std::size_t i = 0; i < W.size(); ++i) {
    if (std::fabs(W[i]) < std::fabs(peak) - 2 * error) continue;
    errors[place] = std::fmax(errors[place], std::fabs((edges[i] + edges[i + 1]) / 2 - x));
    if (W[i] * peak < 0) errors[height] = std::fmax(errors[height], std::fabs(peak - W[i]) + 2 * error);
  }
}

/// Corrects the errors of positions for the size of the cells. Every position has a rounding error. A front that half
/// the cells do not show has an error of two cells. A peak or a crossing has an error of at least one cell. A front
/// that an observer sees at an end of the domain may be anywhere outside, so its error is unknown.
void correct_places(const pulse::Run& run, const std::vector<Row>& summary, std::vector<double>& errors) {
  constexpr double rounding = 1e-9;
  const pulse::Problem& problem = run.problem();
  const double domain = problem.right - problem.left, cell = domain / problem.cells;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const ErrorRule rule = summary[i].about.error;
    const double x = summary[i].number();
    const bool is_front = rule == ErrorRule::front || rule == ErrorRule::observed_front;
    const bool is_read = rule == ErrorRule::position || rule == ErrorRule::peak_position;
    if (!(is_front || is_read || rule == ErrorRule::characteristic) || !std::isfinite(x)) continue;
    if (is_front && std::isnan(errors[i])) errors[i] = 2 * cell;
    const double from_end = std::fmin(std::fabs(x - problem.left), std::fabs(x - problem.right));
    if (rule == ErrorRule::observed_front && from_end <= 2 * cell) errors[i] = none;
    if (std::isfinite(errors[i])) errors[i] = std::fmax(errors[i], is_read ? cell : rounding * domain);
  }
  correct_peak(run, summary, errors);
}

}  // namespace

std::vector<std::string> add_pulse_errors(const pulse::Run& run, std::vector<Row>& summary, const Plan& plan,
                                          const std::function<bool()>& interrupted) {
  const int cells = plan.scenario.pulse.cells;
  const auto coarse = [&](int part, double coarser) -> std::vector<Row> {
    if (cells / part < fewest_cells) return {};
    return if_possible([&] { return summary_with(cells / part, plan.scenario, interrupted, coarser); });
  };
  const std::vector<Row> half = coarse(2, 4);
  const std::vector<Row> quarter = half.empty() ? half : coarse(4, 16);  // without `half`, no error can be estimated
  std::vector<double> errors = estimated(summary, half, quarter);
  std::vector<std::string> warnings;
  if (!half.empty()) correct_places(run, summary, errors);
  if (const auto slip = run.slip_twice()) {
    double& error = errors[row_of(ErrorRule::slip, summary)];
    error = std::fmax(error, slip->error());
  }
  for (std::size_t i = 0; i < quarter.size(); ++i) {
    const double values[] = {quarter[i].number(), half[i].number(), summary[i].number()};
    if (!held_to_tolerance(summary[i]) || !grows(values[2], values[1], values[0])) continue;
    errors[i] = none;
    warnings.push_back("pulse: " + std::string(summary[i].about.name) +
                       " grows with the cells: " + digits(values[0], 3) + ", " + digits(values[1], 3) + ", " +
                       digits(values[2], 3) + " with " + std::to_string(cells / 4) + ", " + std::to_string(cells / 2) +
                       ", " + std::to_string(cells) + "; the pulse is narrower than a cell: increase pulse.cells");
  }
  for (std::size_t i = 0; i < errors.size(); ++i) summary[i].errors = {errors[i]};
  return warnings;
}

namespace {

/// The numbers with a fraction of the cells or of the scale; empty if the run fails or is interrupted.
std::vector<Row> on_plane_with_fewer_cells(const Plan& plan, int divisor, const std::function<bool()>& interrupted,
                                           int threads) {
  scenario::Scenario s = plan.scenario;
  s.plane->loops = std::max(4, s.plane->loops / divisor);
  s.plane->angles = std::max(8, s.plane->angles / divisor);
  if (plan.solver == scenario::SolverKind::plane)
    s.plane->cells = std::max(8, s.plane->cells / divisor);
  else
    s.chain.scale = scenario::scale_of_lines(s) / divisor;
  return if_possible([&] {  // fewer cells may not see a held region
    Plan coarse = plan_of(plan.solver, std::move(s));
    coarse.on_plane.times = {coarse.scenario.end};
    return summary_of(coarse, interrupted, threads);
  });
}

}  // namespace

void add_plane_errors(std::vector<Row>& summary, const Plan& plan, const std::function<bool()>& interrupted,
                      int threads) {
  const scenario::Scenario& s = plan.scenario;
  if (plan.solver == scenario::SolverKind::plane_direct && s.chain.scale) {
    scenario::Scenario by_default = s;
    by_default.chain.scale.reset();
    if (*s.chain.scale < scenario::scale_of_lines(by_default)) return;
  }
  const std::vector<Row> half = on_plane_with_fewer_cells(plan, 2, interrupted, threads),
                         quarter = on_plane_with_fewer_cells(plan, 4, interrupted, threads);
  if (half.empty() || quarter.empty()) return;
  for (std::size_t row = 0; row < summary.size(); ++row) {
    if (summary[row].about.error == ErrorRule::unknown) continue;
    const std::span<const double> f = summary[row].reals(), h = half[row].reals(), q = quarter[row].reals();
    for (std::size_t i = 0; i < f.size(); ++i) summary[row].errors.push_back(safety * change_of(f[i], h[i], q[i]));
  }
}

int cells_for(double tolerance, bool resumed, const scenario::Scenario& scenario,
              const std::function<bool()>& interrupted) {
  if (!(tolerance >= 1e-9 && tolerance <= 1))
    throw InputError(
        {.key = "tolerance", .value = digits(tolerance), .problem = "out of range", .allowed = "1e-9 to 1"});
  if (resumed)
    throw InputError({.key = "tolerance",
                      .problem = "cannot choose the cells of a run that has started",
                      .allowed = "tolerance without resume"});
  const int given = scenario.pulse.cells;
  std::vector<Row> quarter = summary_with(std::max(given / 4, fewest_cells), scenario, interrupted, 16),
                   half = summary_with(std::max(given / 2, fewest_cells), scenario, interrupted);
  double reached = 0, cost = 0;
  int cells = given;
  for (; cells <= most_cells && !quarter.empty() && !half.empty(); cells *= 2) {
    if (cost_of_doubling * cost > most_cost) break;
    std::vector<Row> fine = summary_with(cells, scenario, interrupted, 4, &cost);
    if (fine.empty()) return given;
    reached = largest_relative(fine, estimated(fine, half, quarter));
    if (reached <= tolerance) return cells;
    quarter = std::move(half);
    half = std::move(fine);
  }
  if (quarter.empty() || half.empty()) return given;
  const std::string why = cells > most_cells
                              ? "; more cells are not tried"
                              : "; " + std::to_string(cells) + " cells would take about " +
                                    digits(cost_of_doubling * cost / cells, 2) + " steps, which is too many";
  throw NumericsError("tolerance " + digits(tolerance, 3) + " is not reached with " + std::to_string(cells / 2) +
                      " cells: the error is " + digits(reached, 3) + why +
                      ". Without --tolerance, pulse.cells = " + std::to_string(cells / 2) + " gives that result");
}

}  // namespace slipfront::run
