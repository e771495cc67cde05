#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>

#include "batch.hpp"
#include "commands.hpp"
#include "pulse_setup.hpp"
#include "slipfront/modulation/friction.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/record/pulse_file.hpp"
#include "slipfront/record/table_file.hpp"
#include "slipfront/record/text_file.hpp"

namespace {

using namespace slipfront;
using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupt_seen = 0;
extern "C" void on_interrupt(int) { interrupt_seen = 1; }

struct Arguments {
  CommonOptions common;
  std::string scenario, output, resume;
  std::vector<std::string> set;
  bool check = false;
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A line on a terminal, renewed five times a second: share done, rate, time left.
class Progress {
 public:
  Progress(double end, bool wanted)
      : end_(end), on_(wanted && isatty(STDERR_FILENO)), start_(Clock::now()), shown_(start_) {}
  ~Progress() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void at(const pulse::Cells& cells) {
    if (!on_ || seconds_since(shown_) < 0.2) return;
    shown_ = Clock::now();
    const double share = cells.time / end_, elapsed = seconds_since(start_);
    const double gained = (cells.time - first_time_) / end_;
    const double left = gained > 0 ? elapsed * (1 - share) / gained : 0;
    std::string bar(30, '.');
    for (std::size_t i = 0; i < static_cast<std::size_t>(share * 30); ++i) bar[i] = '#';
    fmt::print(stderr, "\r[{}] {:5.1f} %  t = {:.4g} of {:.4g}  {:.0f} steps/s  {:.0f} s left\x1b[K", bar, 100 * share,
               cells.time, end_, static_cast<double>(cells.steps - first_steps_) / elapsed, left);
    std::fflush(stderr);
    drawn_ = true;
  }
  void from(const pulse::Cells& cells) {
    first_steps_ = cells.steps;
    first_time_ = cells.time;
  }

 private:
  double end_;
  bool on_, drawn_ = false;
  Clock::time_point start_, shown_;
  double first_time_ = 0;
  long first_steps_ = 0;
};

const char* name_of(modulation::Closure closure) {
  return closure == modulation::Closure::paper ? "paper" : "consistent";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

struct Result {
  const scenario::Scenario& scenario;
  const pulse::Run& run;
  double wall;
};

void print(const Result& r, const CommonOptions& options, const std::string& output) {
  const pulse::Snapshot& s = r.run.snapshots().back();
  const modulation::Friction& friction = r.scenario.friction;
  const double conserved = pulse::conservation_error(r.run.solver(), r.run.schedule().x_edges, s.profile);
  const struct {
    const char* key;
    std::string value;
    const char* meaning;
  } rows[] = {
      {"closure", fmt::format("\"{}\"", name_of(friction.closure)), "how friction is averaged"},
      {"friction_coefficient", number(friction.coefficient), "C"},
      {"damping_number", number(friction.coefficient * s.time), "Gamma = C t"},
      {"time", number(s.time), "in b / (c A)"},
      {"slip_velocity_at_origin", number(s.slip_velocity_at_origin), "W at x = 0, in c A / pi"},
      {"stress_at_origin", number(s.stress_at_origin), "Sigma at x = 0, in mu A / pi"},
      {"slip_at_origin", number(s.slip_at_origin), "u at x = 0 since t = 0, in b / (2 pi)"},
      {"peak_slip_velocity", number(s.peak_slip_velocity), "largest W, in c A / pi"},
      {"peak_position", number(s.peak_position), "its x, in b / A"},
      {"trailing_front", number(s.fronts.trailing), "x of the fast front (its characteristic), in b / A"},
      {"leading_front", number(s.fronts.leading), "x of the slow front, in b / A"},
      {"trailing_front_observed", number(s.fronts.trailing_observed), "as an observer with a threshold sees it"},
      {"leading_front_observed", number(s.fronts.leading_observed), "as an observer with a threshold sees it"},
      {"energy_elastic", number(s.energy.elastic), "of the state at rest"},
      {"energy_kinetic", number(s.energy.kinetic), "the rest of H"},
      {"energy_dissipated", number(s.energy.dissipated), "by friction since t = 0"},
      {"energy_supplied", number(s.energy.supplied), "by F since t = 0"},
      {"conservation_error", number(conserved), "of the dislocation number, relative"},
      {"cells", fmt::format("{}", r.run.solver().size()), ""},
      {"steps", fmt::format("{}", r.run.solver().cells().steps), ""},
      {"solve_seconds", number(r.run.stepping_seconds()), "of the time steps alone"},
      {"wall_seconds", number(r.wall), "of the whole command"},
  };
  if (options.json) {
    std::string text = "{";
    for (const auto& row : rows) text += fmt::format("{}\"{}\": {}", text.size() > 1 ? ", " : "", row.key, row.value);
    put(text + "}\n");
    return;
  }
  if (!r.scenario.title.empty()) put(r.scenario.title + "\n");
  for (const auto& row : rows) put(fmt::format("{:<25} {:<24} {}\n", row.key, row.value, row.meaning));
  if (!output.empty() && !options.quiet) put("written to " + output + "\n");
}

void describe(const scenario::Scenario& s, const pulse::Problem& problem, const pulse::Schedule& schedule) {
  put(fmt::format(
      "{}: fine. Would run {} cells over x = {:.6g} ... {:.6g} to t = {:.6g}, {} friction {} (closure {}), {} "
      "snapshots.\n",
      s.title.empty() ? s.file : s.title, problem.cells, problem.left, problem.right, s.end, law_name(s.friction.law),
      s.friction.coefficient, name_of(s.friction.closure), schedule.times.size()));
}

int run_pulse(const Arguments& a) {
  const auto start = Clock::now();
  const scenario::Scenario s =
      scenario::read_scenario(record::read_text(a.scenario), a.scenario, a.set, record::read_profile_table);
  if (!a.common.quiet)
    for (const std::string& warning : s.warnings) complain("warning: " + warning);
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
    const record::Checkpoint saved = record::read_checkpoint(a.resume);
    const auto refuse = [&](const char* what, const std::string& wanted) {
      throw InputError({.file = a.resume,
                        .key = "--resume",
                        .problem = std::string("was written by another ") + what,
                        .allowed = wanted});
    };
    if (saved.scenario_text != s.text) refuse("scenario", "the scenario that began it, with the same --set");
    if (saved.version != SLIPFRONT_VERSION) refuse("version", "version " SLIPFRONT_VERSION);
    run = std::make_unique<pulse::Run>(problem, schedule, saved.solver_state, saved.snapshots);
  }
  const std::string output = a.output.empty() ? a.resume : a.output;
  // The history is that of the run, not of how it was interrupted and resumed: equal runs make equal files.
  const record::PulseMetadata metadata{
      s.title, s.text, SLIPFRONT_VERSION, "slipfront pulse " + a.scenario, schedule.x_edges, s.output.variables};
  auto written = Clock::now();
  double cost = 0;
  const auto write = [&] {
    if (output.empty()) return;
    const auto begun = Clock::now();
    record::write_pulse(output, metadata, run->snapshots(), run->saved(), run->finished());
    cost = seconds_since(begun);
    written = Clock::now();
  };
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (a.resume.empty()) write();  // a path that cannot be written is known before the work, not after

  bool reached = false;
  {
    Progress progress(s.end, !a.common.quiet);
    progress.from(run->solver().cells());
    const auto after_step = [&] {
      progress.at(run->solver().cells());
      // A checkpoint is the whole file: writing it must stay a small part of the work.
      if (seconds_since(written) > std::fmax(0.05, 20 * cost)) write();
      return interrupt_seen != 0;
    };
    try {
      reached = run->go(after_step);
    } catch (const NumericsError& error) {
      write();
      throw NumericsError(std::string(error.what()) + (output.empty() ? "" : "; what was computed is in " + output));
    }
  }
  write();
  if (!reached) {
    complain(output.empty() ? "interrupted; no checkpoint, as there is no -o FILE"
                            : fmt::format("interrupted at t = {:.6g}; go on with --resume {}",
                                          run->solver().cells().time, output));
    return exit_interrupted;
  }
  print({s, *run, seconds_since(start)}, a.common, output);
  return exit_done;
}

}  // namespace

Runner add_pulse(CLI::App& app) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("pulse", "The modulation equations with friction, Eqs. (7), on a scenario");
  command->add_option("SCENARIO", a->scenario, "Scenario file, TOML")->required();
  command->add_option("-o,--output", a->output, "NetCDF file to write")->type_name("OUT.nc");
  command->add_option("--resume", a->resume, "Go on from a file of this scenario, and write to it")
      ->type_name("OUT.nc");
  command->add_option("--set", a->set, "table.key=value, in place of the scenario's; repeatable")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  command->add_flag("--check", a->check, "Read, validate, say what would run, and stop");
  add_common_options(*command, a->common, false);
  return [a] { return run_pulse(*a); };
}
