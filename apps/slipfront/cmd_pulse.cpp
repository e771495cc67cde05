#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "batch.hpp"
#include "long_run.hpp"
#include "slipfront/record/unfinished.hpp"
#include "slipfront/setup/errors.hpp"
#include "slipfront/setup/estimate.hpp"
#include "slipfront/setup/pulse.hpp"
#include "slipfront/setup/summary.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::setup;

void describe(const scenario::Scenario& s, const pulse::Problem& problem, const std::string& output) {
  const Estimate need = estimate_of(s, problem);
  record::require_disk_space(output, need.disk);
  put(fmt::format(
      "{}: fine. Would run {} cells over x = {:.6g} ... {:.6g} to t = {:.6g}, {} friction {} (closure {}), {}.\n",
      s.title.empty() ? s.file : s.title, problem.cells, problem.left, problem.right, s.end, law_name(s.friction.law),
      s.friction.coefficient, name_of(s.friction.closure), in_words(need)));
}

constexpr int fewest_cells = 4, most_cells = 25600;

/// By how much each row differs from a run with half the cells, which takes a quarter of the time. No thread beside the
/// run: files are written by a forked process.
std::vector<double> errors_of(const std::vector<SummaryValue>& fine, const scenario::Scenario& s) {
  std::vector<SummaryValue> coarse;
  try {
    if (s.pulse.cells / 2 >= fewest_cells) coarse = pulse_summary_with(s, s.pulse.cells / 2, {});
  } catch (const InputError&) {
  } catch (const NumericsError&) {  // then the errors are not known
  }
  return differences(fine, coarse);
}

/// The cells that a relative tolerance needs, from the scenario's on in doublings.
int cells_for(double tolerance, const scenario::Scenario& s) {
  std::vector<SummaryValue> coarse =
      pulse_summary_with(s, std::max(s.pulse.cells / 2, fewest_cells), interrupted_by_user);
  double reached = 0;
  for (int cells = s.pulse.cells; cells <= most_cells && !coarse.empty(); cells *= 2) {
    std::vector<SummaryValue> fine = pulse_summary_with(s, cells, interrupted_by_user);
    if (fine.empty()) return s.pulse.cells;
    reached = largest_relative(fine, differences(fine, coarse));
    if (reached <= tolerance) return cells;
    coarse = std::move(fine);
  }
  if (coarse.empty()) return s.pulse.cells;  // interrupted: the run will be too
  throw NumericsError(
      fmt::format("--tolerance {:.3g} is not reached with {} cells: {:.3g} is", tolerance, most_cells, reached));
}

int run_pulse(ScenarioArguments a, std::optional<double> tolerance) {
  const auto start = Clock::now();
  if (tolerance) {
    if (!a.resume.empty())
      throw InputError({.file = "command line",
                        .key = "--tolerance",
                        .problem = "chooses the cells of a run that has begun",
                        .allowed = "--tolerance without --resume"});
    a.set.push_back(fmt::format("pulse.cells={}", cells_for(*tolerance, read_scenario_of(a))));
  }
  const scenario::Scenario s = read_scenario_of(a);
  const pulse::Problem problem = pulse_problem(s);
  const pulse::Schedule schedule = pulse_schedule(s, problem);
  if (a.check) {
    check_cells(s, problem);
    describe(s, problem, a.output);
    return exit_done;
  }
  std::unique_ptr<pulse::Run> run;
  if (a.resume.empty()) {
    run = std::make_unique<pulse::Run>(problem, schedule);
  } else {
    const record::Checkpoint saved = checkpoint_of(a, s);
    run = std::make_unique<pulse::Run>(problem, schedule, saved.solver_state, saved.snapshots);
  }
  const int code = carry_out(
      *run, a, s, "pulse", estimate_of(s, problem).disk, [&] { return run->solver().cells().time; },
      [&] { return run->solver().cells().steps; });
  if (code != exit_done) return code;
  const std::vector<SummaryValue> values = summary(pulse_summary(), {s, *run, seconds_since(start)});
  print_summary(s.title, values, errors_of(values, s), run->warnings(), a);
  return code;
}

}  // namespace

Runner add_pulse(CLI::App& app) {
  auto a = std::make_shared<ScenarioArguments>();
  CLI::App* command = app.add_subcommand("pulse", "The modulation equations with friction, Eqs. (7), on a scenario");
  add_scenario_options(*command, *a);
  auto tolerance = std::make_shared<std::optional<double>>();
  command
      ->add_option("--tolerance", *tolerance,
                   "Relative error of slip, slip velocity and stress at x = 0: doubles pulse.cells until reached")
      ->check(CLI::Range(1e-9, 1.0))
      ->type_name("ERROR");
  return [a, tolerance] { return run_pulse(*a, *tolerance); };
}
