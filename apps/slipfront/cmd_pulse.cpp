#include <CLI/CLI.hpp>
#include <memory>

#include "batch.hpp"
#include "long_run.hpp"
#include "pulse_setup.hpp"
#include "slipfront/modulation/friction.hpp"
#include "slipfront/pulse/run.hpp"

namespace {

using namespace slipfront;

const char* name_of(modulation::Closure closure) {
  return closure == modulation::Closure::paper ? "paper" : "consistent";
}

struct Result {
  const scenario::Scenario& scenario;
  const pulse::Run& run;
  double wall;
};

void print(const Result& r, const ScenarioArguments& arguments) {
  const pulse::Snapshot& s = r.run.snapshots().back();
  const modulation::Friction& friction = r.scenario.friction;
  const double conserved = pulse::conservation_error(r.run.solver(), r.run.schedule().x_edges, s.profile);
  const std::vector<ResultRow> rows = {
      {"closure", fmt::format("\"{}\"", name_of(friction.closure)), "how friction is averaged"},
      {"friction_coefficient", json_number(friction.coefficient), "C"},
      {"damping_number", json_number(friction.coefficient * s.time), "Gamma = C t"},
      {"time", json_number(s.time), "in b / (c A)"},
      {"slip_velocity_at_origin", json_number(s.slip_velocity_at_origin), "W at x = 0, in c A / pi"},
      {"stress_at_origin", json_number(s.stress_at_origin), "Sigma at x = 0, in mu A / pi"},
      {"slip_at_origin", json_number(s.slip_at_origin), "u at x = 0 since t = 0, in b / (2 pi)"},
      {"peak_slip_velocity", json_number(s.peak_slip_velocity), "largest W, in c A / pi"},
      {"peak_position", json_number(s.peak_position), "its x, in b / A"},
      {"trailing_front", json_number(s.fronts.trailing), "x of the fast front (its characteristic), in b / A"},
      {"leading_front", json_number(s.fronts.leading), "x of the slow front, in b / A"},
      {"trailing_front_observed", json_number(s.fronts.trailing_observed), "as an observer with a threshold sees it"},
      {"leading_front_observed", json_number(s.fronts.leading_observed), "as an observer with a threshold sees it"},
      {"energy_elastic", json_number(s.energy.elastic), "of the state at rest"},
      {"energy_kinetic", json_number(s.energy.kinetic), "the rest of H"},
      {"energy_dissipated", json_number(s.energy.dissipated), "by friction since t = 0"},
      {"energy_supplied", json_number(s.energy.supplied), "by F since t = 0"},
      {"conservation_error", json_number(conserved), "of the dislocation number, relative"},
      {"cells", fmt::format("{}", r.run.solver().size()), ""},
      {"steps", fmt::format("{}", r.run.solver().cells().steps), ""},
      {"solve_seconds", json_number(r.run.stepping_seconds()), "of the time steps alone"},
      {"wall_seconds", json_number(r.wall), "of the whole command"},
  };
  print_rows(r.scenario.title, rows, arguments);
}

void describe(const scenario::Scenario& s, const pulse::Problem& problem, const pulse::Schedule& schedule) {
  put(fmt::format(
      "{}: fine. Would run {} cells over x = {:.6g} ... {:.6g} to t = {:.6g}, {} friction {} (closure {}), {} "
      "snapshots.\n",
      s.title.empty() ? s.file : s.title, problem.cells, problem.left, problem.right, s.end, law_name(s.friction.law),
      s.friction.coefficient, name_of(s.friction.closure), schedule.times.size()));
}

int run_pulse(const ScenarioArguments& a) {
  const auto start = Clock::now();
  const scenario::Scenario s = read_scenario_of(a);
  const pulse::Problem problem = pulse_problem(s);
  const pulse::Schedule schedule = pulse_schedule(s, problem);
  if (a.check) {
    const pulse::Run laid(problem, schedule);  // what is wrong with the cells is said here
    describe(s, problem, laid.schedule());
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
      *run, a, s, "pulse", [&] { return run->solver().cells().time; }, [&] { return run->solver().cells().steps; });
  if (code == exit_done) print({s, *run, seconds_since(start)}, a);
  return code;
}

}  // namespace

Runner add_pulse(CLI::App& app) {
  auto a = std::make_shared<ScenarioArguments>();
  CLI::App* command = app.add_subcommand("pulse", "The modulation equations with friction, Eqs. (7), on a scenario");
  add_scenario_options(*command, *a);
  return [a] { return run_pulse(*a); };
}
