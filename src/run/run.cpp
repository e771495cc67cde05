#include "run/run.hpp"

#include <utility>

#include "record/files/unfinished.hpp"
#include "record/pulses/comparison_file.hpp"
#include "run/carry_out.hpp"
#include "scenario/solver_errors.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::run {
namespace {

/// A run from its beginning, or from where the checkpoint left it.
template <class Run, class... Arguments>
std::unique_ptr<Run> begun(const Options& options, const Arguments&... arguments) {
  if (!options.checkpoint) return std::make_unique<Run>(arguments...);
  return std::make_unique<Run>(arguments..., options.checkpoint->solver_state, options.checkpoint->snapshots);
}

}  // namespace

void require_inputs_kept(const scenario::Scenario& scenario, const std::string& output) {
  if (!output.empty()) record::require_other_file(output, scenario::files_of(scenario));
}

void choose_units(scenario::Scenario& scenario, std::optional<bool> in_si) {
  scenario.results_in.reset();
  if (!in_si.value_or(scenario.in_si)) return;
  try {
    scenario.results_in.emplace(scenario.medium);
    for (std::string& warning : scenario.warnings) warning = scenario::in_results(warning, scenario.results_in);
  } catch (const InputError& error) {
    if (in_si)
      throw InputError(
          {.file = scenario.file, .problem = error.complaint().problem, .allowed = error.complaint().allowed});
    scenario.warnings.push_back("the results are in the units of the model: " + error.complaint().problem);
    return;
  }
  const std::string& assumed = scenario.results_in->assumed();
  if (!assumed.empty() && !scenario.in_si)  // else the reader of the scenario has warned
    scenario.warnings.push_back("SI units were converted with " + assumed + ", which [medium] does not give");
}

record::PulseMetadata metadata_of(const scenario::Scenario& scenario, const std::string& command,
                                  const std::vector<double>& x_edges, const std::vector<double>& scales) {
  std::vector<std::string> variables = scenario.output.variables;
  if (!scenario.pulse.many_trains || command != "pulse")
    std::erase(variables, "trains");
  else if (variables.empty())
    variables = record::pulse_variables();
  // The history is that of the run, not of how it was interrupted and resumed: equal runs make equal files.
  return {.title = scenario.title,
          .scenario_text = scenario.text,
          .version = SLIPFRONT_VERSION,
          .command_line = scenario::command_line(scenario, command, scales),
          .x_edges = x_edges,
          .variables = std::move(variables),
          .warnings = scenario.warnings,
          .pulled_end = scenario.loading.acts() && scenario.loading.where != chain::Pulled::everywhere,
          .units = scenario.results_in};
}

PulsePlan plan_pulse(const scenario::Scenario& scenario) {
  const auto make = [&] {
    PulsePlan plan{.problem = scenario::pulse_problem(scenario), .schedule = {}, .need = {}, .file = scenario.file};
    plan.schedule = scenario::pulse_schedule(scenario, plan.problem);
    plan.need = scenario::estimate_of(scenario, plan.problem);
    return plan;
  };
  return scenario::with_units(scenario,
                              [&] { return scenario::with_keys(scenario::SolverKind::pulse, scenario.file, make); });
}

ChainPlan plan_chain(const scenario::Scenario& scenario, double share_of_machine) {
  const auto make = [&] {
    ChainPlan plan{.chain = scenario::chain_problem(scenario),
                   .schedule = scenario::pulse_schedule(scenario, scenario::stated_problem(scenario)),
                   .need = {},
                   .file = scenario.file};
    plan.schedule.displacement = scenario.output.displacement;
    plan.schedule.dislocations = scenario.output.dislocations;
    scenario::require_memory(scenario, plan.chain, share_of_machine);
    plan.need = scenario::estimate_of(scenario, plan.chain);
    return plan;
  };
  return scenario::with_units(scenario,
                              [&] { return scenario::with_keys(scenario::SolverKind::chain, scenario.file, make); });
}

std::unique_ptr<pulse::Run> begin(const PulsePlan& plan, const Options& options) {
  return scenario::with_keys(scenario::SolverKind::pulse, plan.file,
                             [&] { return begun<pulse::Run>(options, plan.problem, plan.schedule); });
}

std::unique_ptr<chain::Run> begin(const ChainPlan& plan, const Options& options) {
  const chain::Execution execution{.threads = options.threads, .ranks = options.ranks};
  return scenario::with_keys(scenario::SolverKind::chain, plan.file,
                             [&] { return begun<chain::Run>(options, plan.chain, plan.schedule, execution); });
}

Result<pulse::Run> pulse(const scenario::Scenario& scenario, const PulsePlan& plan, const Options& options) {
  Result<pulse::Run> result{.run = scenario::with_units(scenario, [&] { return begin(plan, options); }),
                            .metadata = metadata_of(scenario, "pulse", plan.schedule.x_edges)};
  const auto write = [&run = *result.run](const std::string& path, const record::PulseMetadata& metadata,
                                          const std::string& state) {
    record::write_pulse(path, metadata, run.snapshots(), state, run.finished());
  };
  if (!carry_out(result, options, plan.need.disk, write)) return result;
  result.summary = rows_of({*result.run, seconds_since(options.begun)});
  return result;
}

Result<chain::Run> chain(const scenario::Scenario& scenario, const ChainPlan& plan, const Options& options) {
  Result<chain::Run> result{.run = scenario::with_units(scenario, [&] { return begin(plan, options); }),
                            .metadata = metadata_of(scenario, "chain", plan.schedule.x_edges)};
  const chain::Run& run = *result.run;
  if (plan.schedule.displacement) result.metadata.sites = run.sites();
  result.metadata.paths = run.path_settings();
  const long first = run.steps();
  const auto begun = Clock::now();
  const bool reached =
      carry_out(result, options, plan.need.disk,
                [&](const std::string& path, record::PulseMetadata metadata, const std::string& state) {
                  metadata.events = run.events();
                  metadata.fronts = run.fronts();
                  record::write_pulse(path, metadata, run.snapshots(), state, run.finished());
                });
  const double stepping = seconds_since(begun);
  result.metadata.events = run.events();
  result.metadata.fronts = run.fronts();
  if (!reached) return result;
  const chain::Averages averages = run.averages();
  result.summary = rows_of({.run = run,
                            .balance = run.balance(),  // asks all ranks
                            .averages = averages,
                            .stepping = stepping,
                            .wall = seconds_since(options.begun),
                            .steps = run.steps() - first,
                            .ranks = options.ranks ? options.ranks->size() : 1,
                            .threads = options.threads});
  return result;
}

bool compare(const scenario::Scenario& scenario, const Comparison& comparison, const std::vector<double>& scales,
             const record::Output& output, int threads, std::vector<Level>& levels,
             const std::function<void()>& next_level,
             const std::function<bool(const std::string& level, double time, long steps)>& after_step) {
  const auto write = [&](bool finished) {
    if (!output.wanted()) return;
    std::vector<record::ComparedLevel> compared;
    compared.reserve(levels.size());
    for (const Level& level : levels) compared.push_back({level.name, level.scale, level.snapshots});
    record::write_comparison(finished ? output.finished() : output.unfinished(),
                             metadata_of(scenario, "compare", comparison.schedule.x_edges, scales),
                             comparison.schedule.times, compared, finished);
    if (finished) output.clear();
  };
  const auto next = [&] {
    next_level();
    write(false);
  };
  const bool reached = run_levels(comparison, threads, levels, next, after_step);
  write(reached);
  return reached;
}

}  // namespace slipfront::run
