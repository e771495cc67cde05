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

std::string pulse_in_words(const run::Plan& plan, const output::Run& run) {
  const scenario::Scenario& s = plan.scenario;
  const pulse::Problem& problem = plan.pulse;
  return fmt::format("run {} cells over x = {} ... {} to t = {}, {} (closure {}), {}, about {:.0f} steps",
                     problem.cells, s.in_results(problem.left, "b / A"), s.in_results(problem.right, "b / A"),
                     s.in_results(s.end, "b / (c A)"), parameters_in_words(s.friction), name_of(s.friction.closure()),
                     in_words(plan.need), two_digits(run.expected_steps()));
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
