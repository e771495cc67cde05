#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "interrupts.hpp"
#include "long_run.hpp"
#include "runs/errors.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::scenario;

double two_digits(double value) {
  const double last = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::round(value / last) * last;
}

/// About how many steps the run takes and how long, from the time of its first steps. Empty where many cells would make
/// these long. The estimate of errors takes another third. \throws NumericsError if the first steps fail.
std::string duration_of(const pulse::Problem& problem, output::Run& run) {
  constexpr int most_cells = 100000;
  constexpr long enough_steps = 20;
  constexpr double enough_seconds = 0.2, with_errors = 4.0 / 3;
  if (problem.cells > most_cells) return {};
  long steps = 0;
  const auto begun = Clock::now();
  run.go([&] { return ++steps == enough_steps || seconds_since(begun) > enough_seconds; });
  const double expected = run.expected_steps(), each = seconds_since(begun) / static_cast<double>(steps);
  return fmt::format(", about {:.0f} steps and {:.2g} s", two_digits(expected), with_errors * expected * each);
}

std::string pulse_in_words(const run::Plan& plan, output::Run& run) {
  const scenario::Scenario& s = plan.scenario;
  const pulse::Problem& problem = plan.pulse;
  return fmt::format("run {} cells over x = {} ... {} to t = {}, {} (closure {}), {}{}", problem.cells,
                     s.in_results(problem.left, "b / A"), s.in_results(problem.right, "b / A"),
                     s.in_results(s.end, "b / (c A)"), parameters_in_words(s.friction), name_of(s.friction.closure()),
                     in_words(plan.need), duration_of(problem, run));
}

int run_pulse(ScenarioArguments a, std::optional<double> tolerance) {
  const auto make_plan = [&] {
    if (tolerance) {
      const int cells = run::cells_for(*tolerance, !a.resume.empty(), read_scenario_of(a), interrupted_by_user);
      a.set.push_back(fmt::format("pulse.cells={}", cells));
    }
    return run::plan_of(scenario::SolverKind::pulse, read_scenario_of(a));
  };
  return plan_and_run(a, Clock::now(), make_plan, pulse_in_words);
}

}  // namespace

Runner add_pulse(CommandLine& program) {
  auto a = std::make_shared<ScenarioArguments>();
  CommandLine command = program.command("pulse", "The modulation equations with friction, Eqs. (7), on a scenario",
                                        {"slipfront pulse cases/fig-08.toml -o pulse.nc",
                                         "slipfront pulse cases/fig-08.toml --set friction.coefficient=2 --json",
                                         "slipfront pulse cases/fig-08.toml --check"});
  add_scenario_options(command, *a);
  auto tolerance = std::make_shared<std::optional<double>>();
  command.option(
      "--tolerance", "ERROR", *tolerance,
      "Relative error of slip, slip velocity and stress at x = 0; pulse.cells is doubled until it is reached");
  return [a, tolerance] { return run_pulse(*a, *tolerance); };
}
