#include "run/compare.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "foundation/clock.hpp"
#include "foundation/text/digits.hpp"
#include "scenario/estimate.hpp"
#include "scenario/solver_errors.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/problem.hpp"

namespace slipfront::run {
namespace {

std::vector<double> checked(std::vector<double> scales, const scenario::Scenario& s) {
  const auto refuse = [](double scale, const char* problem, const char* allowed) {
    throw InputError(
        {.file = "command line", .key = "--scale", .value = digits(scale), .problem = problem, .allowed = allowed});
  };
  for (const double scale : scales)
    if (!(scale > 0) || !std::isfinite(scale)) refuse(scale, "out of range", "> 0");
  if (scales.empty()) scales = s.chain.scale ? std::vector{*s.chain.scale} : std::vector{100.0, 300.0, 1000.0};
  std::sort(scales.begin(), scales.end());
  if (const auto twice = std::adjacent_find(scales.begin(), scales.end()); twice != scales.end())
    refuse(*twice, "given twice", "each scale once");
  return scales;
}

/// The closures of the pulse levels.
std::vector<friction::Closure> closures_of(const Comparison& c) {
  std::vector<friction::Closure> closures{friction::Closure::consistent};
  if (c.problem.friction.defined_by(friction::Closure::paper)) closures.push_back(friction::Closure::paper);
  return closures;
}

pulse::Run pulse_of(const Comparison& c, friction::Closure closure) {
  pulse::Problem problem = c.problem;
  problem.friction = problem.friction.with(closure);
  return scenario::with_keys(scenario::SolverKind::pulse, c.file,
                             [&] { return pulse::Run(std::move(problem), c.schedule); });
}

chain::Run chain_of(const Comparison& c, const chain::ScaledProblem& scaled, int threads) {
  return scenario::with_keys(scenario::SolverKind::chain, c.file,
                             [&] { return chain::Run(scaled, c.schedule, {.threads = threads}); });
}

/// Runs one level to its end; false if stopped.
template <class Run>
bool carry(Run& run, Level& level, const std::function<bool()>& after_step) {
  const auto begun = Clock::now();
  bool reached = false;
  try {
    reached = run.go(after_step);
  } catch (const NumericsError& error) {
    throw NumericsError(level.name + ": " + error.what());
  }
  level.wall_seconds = seconds_since(begun);
  level.snapshots = run.snapshots();
  level.warnings = run.warnings();
  return reached;
}

}  // namespace

Comparison comparison_of(scenario::Scenario scenario, std::vector<double> scales) {
  Comparison c{.file = scenario.file};
  c.problem = scenario::pulse_problem(scenario);
  c.schedule = scenario::pulse_schedule(scenario, c.problem);
  for (const double scale : checked(std::move(scales), scenario)) {
    scenario.chain.scale = scale;
    c.chains.push_back(scenario::chain_problem(scenario));
    scenario::with_keys(scenario::SolverKind::chain, scenario.file, [&] { return chain::problem_of(c.chains.back()); });
  }
  scenario::require_memory(scenario, c.chains);  // before the closed form, which is observed at once
  c.exact = closed_form(scenario, c.schedule);
  return c;
}

void begin_levels(const Comparison& c) {
  for (const friction::Closure closure : closures_of(c)) pulse_of(c, closure);
  for (const chain::ScaledProblem& scaled : c.chains) chain_of(c, scaled, 1);
}

bool run_levels(const Comparison& c, int threads, std::vector<Level>& levels, const std::function<void()>& next,
                const std::function<bool(const std::string& level, double time, long steps)>& after_step) {
  if (c.exact) levels.push_back(*c.exact);
  for (const friction::Closure closure : closures_of(c)) {
    next();
    const char* name = name_of(closure);
    Level level{.name = std::string("pulse-") + name, .closure = name};
    pulse::Run run = pulse_of(c, closure);
    const auto after = [&] { return after_step(level.name, run.time(), run.steps()); };
    if (!carry(run, level, after)) return false;
    levels.push_back(std::move(level));
  }
  for (const chain::ScaledProblem& scaled : c.chains) {
    next();
    Level level{.name = "chain-" + digits(scaled.scale), .scale = scaled.scale};
    chain::Run run = chain_of(c, scaled, threads);
    level.window = run.window();
    if (!carry(run, level, [&] { return after_step(level.name, run.time(), run.chain().steps()); })) return false;
    level.smooth_window = run.averages().width;
    levels.push_back(std::move(level));
  }
  return true;
}

}  // namespace slipfront::run
