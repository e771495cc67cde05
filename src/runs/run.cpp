#include "runs/run.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "math/digits.hpp"
#include "runs/errors.hpp"
#include "runs/fault.hpp"
#include "runs/record/run_file.hpp"
#include "runs/tables.hpp"
#include "slipfront/lattice/chain/problem.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::run {
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

record::RunMetadata metadata_of(const scenario::Scenario& scenario, const char* format, const std::string& command,
                                const std::vector<double>& scales) {
  std::vector<std::string> variables = scenario.output.variables;
  if (!scenario.pulse.many_trains || command != "pulse")
    std::erase(variables, "trains");
  else if (variables.empty())
    variables = record::pulse_variables();
  // The history is that of the run, not of how it was interrupted and resumed: equal runs make equal files.
  return {.format = format,
          .title = scenario.title,
          .scenario_text = scenario.text,
          .version = SLIPFRONT_VERSION,
          .command_line = scenario::command_line(scenario, command, scales),
          .variables = std::move(variables),
          .warnings = scenario.warnings,
          .units = scenario.results_in};
}

namespace {

void plan_line(Plan& plan) {
  const scenario::Scenario& s = plan.scenario;
  if (plan.solver == scenario::SolverKind::pulse) {
    plan.pulse = scenario::pulse_problem(s);
    plan.on_line = scenario::pulse_schedule(s, plan.pulse);
    plan.need = scenario::estimate_of(s, plan.pulse);
    return;
  }
  plan.chain = scenario::chain_problem(s);
  plan.on_line = scenario::pulse_schedule(s, scenario::stated_problem(s));
  plan.on_line.displacement = s.output.displacement;
  plan.on_line.dislocations = s.output.dislocations;
  scenario::require_memory(s, plan.chain, plan.share_of_machine);
  plan.need = scenario::estimate_of(s, plan.chain);
}

/// A run from its beginning, or from where the checkpoint left it with these `snapshots`. Its numbers and arrays.
template <class Run, class Snapshots, class... Problem>
Result begun(const Plan& plan, const Options& options, const char* command, Snapshots record::Checkpoint::*snapshots,
             Problem&&... problem) {
  std::unique_ptr<Run> owned;
  if (const auto& saved = options.checkpoint)
    owned = std::make_unique<Run>(std::forward<Problem>(problem)..., saved->solver_state, (*saved).*snapshots);
  else
    owned = std::make_unique<Run>(std::forward<Problem>(problem)...);
  const Run& run = *owned;
  Result result{.run = std::move(owned), .metadata = metadata_of(plan.scenario, plan.format(), command)};
  result.arrays = [&run, variables = result.metadata.variables] { return record::arrays_of(run, variables); };
  result.numbers = [&run](const output::Spent& spent) { return rows_of(run, spent); };
  return result;
}

/// The run of a result that was begun as one of this kind.
template <class Run>
const Run& the(const Result& result) {
  return static_cast<const Run&>(*result.run);
}

Result begin_pulse(const Plan& plan, const Options& options) {
  Result result = begun<pulse::Run>(plan, options, "pulse", &record::Checkpoint::snapshots, plan.pulse, plan.on_line);
  const pulse::Run& run = the<pulse::Run>(result);
  result.snapshots = [&run]() -> auto& { return run.snapshots(); };
  result.add_errors = [&run, &plan](std::vector<Row>& summary, const std::function<bool()>& interrupted) {
    return add_pulse_errors(run, summary, plan, interrupted);
  };
  result.cost_of_errors = cost_of_pulse_errors;
  return result;
}

Result begin_chain(const Plan& plan, const Options& options) {
  const chain::Execution execution{.threads = options.threads, .ranks = options.ranks};
  Result result =
      begun<chain::Run>(plan, options, "chain", &record::Checkpoint::snapshots, plan.chain, plan.on_line, execution);
  const chain::Run& run = the<chain::Run>(result);
  result.snapshots = [&run]() -> auto& { return run.snapshots(); };
  if (plan.chain.loading.acts()) result.events = [&run] { return run.events(); };
  return result;
}

Result begin_plane(const Plan& plan, const Options& options) {
  const char* const command = plan.solver == scenario::SolverKind::plane ? "plane" : "plane --direct";
  Result result = begun<plane::Run>(plan, options, command, &record::Checkpoint::fields,
                                    scenario::plane_solver(plan.scenario, plan.solver, options.threads, options.ranks),
                                    plan.on_plane);
  const plane::Run& run = the<plane::Run>(result);
  if (plan.model)
    result.numbers = [&run, &plan](const output::Spent& spent) {
      std::vector<Row> rows = rows_of(run, spent);
      for (Row& row : compare_with_model(*plan.model, plan.scenario, run)) rows.push_back(std::move(row));
      return rows;
    };
  if (!options.ranks && !plan.model) {  // processes that share a run do not share coarser ones
    result.cost_of_errors = cost_of_plane_errors;
    result.add_errors = [&plan, threads = options.threads](std::vector<Row>& summary,
                                                           const std::function<bool()>& interrupted) {
      add_plane_errors(summary, plan, interrupted, threads);
      return std::vector<std::string>{};
    };
  }
  return result;
}

}  // namespace

Plan plan_of(scenario::SolverKind solver, scenario::Scenario s, double share_of_machine) {
  Plan plan{.solver = solver, .scenario = std::move(s), .share_of_machine = share_of_machine};
  if (!plan.is_on_plane()) {
    scenario::with_units(plan.scenario,
                         [&] { scenario::with_keys(solver, plan.scenario.file, [&] { plan_line(plan); }); });
    return plan;
  }
  plan.on_plane = scenario::plane_schedule(plan.scenario, solver);
  plan.need.disk = plane::memory_of_results(plan.on_plane) + (1 << 16);
  return plan;
}

Result begin(const Plan& plan, const Options& options) {
  return scenario::with_units(plan.scenario, [&] {
    if (plan.is_on_plane()) return begin_plane(plan, options);
    return scenario::with_keys(plan.solver, plan.scenario.file, [&] {
      return plan.solver == scenario::SolverKind::pulse ? begin_pulse(plan, options) : begin_chain(plan, options);
    });
  });
}

namespace {

/// A file that a run continues, the scenario that began it, and the one that continues it.
struct Continued {
  const std::string& path;
  const scenario::Scenario& begun;
  const scenario::Scenario& now;

  [[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::string& allowed) const {
    throw InputError({.file = path, .key = key, .problem = problem, .allowed = allowed});
  }
};

/// The part of the scenario that may differ with a later end, and differs.
std::string free_part(const Continued& c) {
  if (c.begun.output.every != c.now.output.every) return "output.every differs";
  if (c.begun.output.times != c.now.output.times) return "output.times differs";
  return c.begun.title != c.now.title ? "title differs" : "comments or layout differ";
}

void require_later_end(const Continued& c) {
  const std::string key = scenario::differing_key(c.begun.text, c.now.text);
  if (!key.empty())
    c.refuse("resume", "was written by another scenario: " + key + " differs",
             "the scenario that started the run, with the same --set; time.end may be later");
  if (c.now.end == c.begun.end)
    c.refuse("resume", "was written by another scenario: " + free_part(c),
             "the scenario that started the run, or a later time.end, with which this may differ");
  if (c.now.end < c.begun.end)
    c.refuse("resume",
             "time.end = " + shortest(c.now.end) + " is earlier than the end of the file, " + shortest(c.begun.end),
             "time.end >= " + shortest(c.begun.end));
}

/// Something that follows from time.end, and that a run uses from its start.
struct Choice {
  std::string what;
  std::vector<double> values;
  std::string in_words, remedy;
};

Choice domain(double left, double right) {
  return {"the domain",
          {left, right},
          "x = " + digits(left) + " ... " + digits(right),
          "a new run with domain.left and domain.right, which can be continued"};
}

Choice number(const char* what, double value, const char* remedy) { return {what, {value}, digits(value), remedy}; }

std::vector<Choice> choices_of(const Plan& plan) {
  const char* const a_new_run = "a new run";
  if (plan.is_on_plane()) return {number("the time between two rows of the series", plan.on_plane.interval, a_new_run)};
  if (plan.solver == scenario::SolverKind::pulse)
    return {domain(plan.pulse.left, plan.pulse.right),
            number("the longest step under a forcing", plan.pulse.longest_step, a_new_run)};
  std::vector<Choice> choices = {domain(plan.chain.left, plan.chain.right),
                                 number("the spacing of sites, as contacts age,", plan.chain.spacing,
                                        "a new run with chain.spacing, which can be continued")};
  const chain::Problem chain = chain::problem_of(plan.chain, plan.share_of_machine);
  if (!chain.implicit)
    choices.push_back(
        number("the time step", chain::chosen_step(chain), "a new run, or chain.steps = \"implicit\" in one"));
  return choices;
}

void require_same_choices(const Continued& c, const std::vector<Choice>& begun, const std::vector<Choice>& now) {
  for (std::size_t i = 0; i < std::min(begun.size(), now.size()); ++i)
    if (begun[i].values != now[i].values)
      c.refuse("resume",
               begun[i].what + " follows from time.end: " + begun[i].in_words + " with end " + shortest(c.begun.end) +
                   " of the file, " + now[i].in_words + " with end " + shortest(c.now.end),
               begun[i].remedy);
}

/// Refuses other output times before the end of the file. Returns whether the end of the file is still an output time.
bool require_common_times(const Continued& c, const std::vector<double>& begun, const std::vector<double>& now) {
  const std::size_t before_end = begun.size() - 1;
  const double end = begun.back(), nearly = end * (1 - 1e-12);  // as for output.every
  const auto [was, is] = std::mismatch(begun.begin(), begun.end() - 1, now.begin(), now.end());
  const double first = was == begun.end() - 1 ? *is : std::min(*was, *is);  // now ends later, so `is` exists
  if (first < nearly)
    c.refuse(
        "resume",
        "the output times before the end of the file, " + shortest(end) + ", differ: first at t = " + shortest(first),
        "the output times of the file; later ones are free");
  return before_end < now.size() && now[before_end] == end;
}

/// Leaves out the snapshot at the end of the file unless it is an output time now.
template <class Snapshots>
void keep_common_snapshots(bool still_output, double end, Snapshots& snapshots) {
  if (!snapshots.empty() && snapshots.back().time == end && !still_output) snapshots.pop_back();
}

}  // namespace

record::Output output_of(const std::string& output, const std::string& resume, bool of_finished) {
  return {output.empty() ? resume : output, of_finished ? "" : resume};
}

record::Checkpoint checkpoint_of(const std::string& path, const Plan& plan) {
  const scenario::Scenario& scenario = plan.scenario;
  record::Checkpoint saved = record::read_checkpoint(path, plan.format());
  if (saved.version != SLIPFRONT_VERSION)
    throw InputError({.file = path,
                      .key = "resume",
                      .problem = "was written by another version",
                      .allowed = "version " SLIPFRONT_VERSION});
  if (saved.scenario_text == scenario.text) return saved;
  const scenario::Scenario begun = scenario::read_scenario(saved.scenario_text, scenario.file, {}, read_table);
  const Continued continued{path, begun, scenario};
  require_later_end(continued);
  const Plan first = plan_of(plan.solver, begun, plan.share_of_machine);
  require_same_choices(continued, choices_of(first), choices_of(plan));
  const bool still_output = require_common_times(continued, first.times(), plan.times());
  keep_common_snapshots(still_output, first.times().back(), saved.snapshots);
  keep_common_snapshots(still_output, first.times().back(), saved.fields);
  return saved;
}

}  // namespace slipfront::run
