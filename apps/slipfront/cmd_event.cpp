#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>

#include "commands.hpp"
#include "event_run.hpp"
#include "slipfront/error.hpp"

namespace {

int run_event(const EventArguments& a) {
  const bool to_file = !a.output.empty() || !a.resume.empty();
  if (a.draws > 0 && !to_file)
    throw slipfront::InputError({.file = "command line",
                                 .key = "--draws",
                                 .value = std::to_string(a.draws),
                                 .problem = "there is no file to write the draws to",
                                 .allowed = "with -o OUT.nc"});
  if (a.fault_grid && !std::string_view(a.output).ends_with(".nc"))
    throw slipfront::InputError({.file = "command line",
                                 .key = "--fault-grid",
                                 .problem = "there is no NetCDF file to write the grid to",
                                 .allowed = "with -o OUT.nc"});
  if (a.damping_number && (a.fault_grid || !describes_fault(a)))
    throw slipfront::InputError({.file = "command line",
                                 .key = "--damping-number",
                                 .value = std::to_string(*a.damping_number),
                                 .problem = "no source is written",
                                 .allowed = "with -o OUT.srf"});
  return to_file ? write_events(a) : print_events(a);
}

void add_medium_options(CLI::App* command, slipfront::medium::StatedDefaults& medium) {
  command
      ->add_option("--p-wave-speed", medium.p_wave_speed, "For events that give no elastic constants (default: 6 km/s)")
      ->type_name("SPEED");
  command
      ->add_option("--poisson-ratio", medium.poisson_ratio, "For events that give no elastic constants (default: 0.3)")
      ->type_name("RATIO");
  command
      ->add_option("--shear-modulus", medium.shear_modulus,
                   "For events that give no elastic constants (default: 30 GPa)")
      ->type_name("MODULUS");
}

void add_sampling_options(CLI::App* command, EventArguments& arguments) {
  command
      ->add_option("--samples", arguments.samples,
                   "Sample every event with this many states of the fault (default: 1000 for events that carry an "
                   "uncertainty, a contact ratio, a stress drop or a friction coefficient; 0: none). Their number is "
                   "doubled until it suffices for intervals")
      ->check(CLI::Range(0, 10000000))
      ->type_name("N");
  command
      ->add_option("--draws", arguments.draws,
                   "Write this many states of the posterior of each sampled event too (with -o OUT.nc)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  command->add_option("--seed", arguments.seed, "Seed of the samples (default: 1)")->type_name("N");
  command->add_option("--closure", arguments.closure, "Closure of the friction: consistent (default) or paper")
      ->check(CLI::IsMember({"consistent", "paper"}))
      ->type_name("NAME");
}

void add_source_options(CLI::App* command, EventArguments& arguments) {
  command->add_flag(
      "--fault-grid", arguments.fault_grid,
      "Write the subfaults of one .fsp to OUT.nc instead of events: rupture time, slip, rise time and static "
      "stress drop on a grid");
  command
      ->add_option("--damping-number", arguments.damping_number,
                   "Slip-rate functions of OUT.srf: damping number at the end of the rise time; 0: constant slip rate "
                   "(default: 10)")
      ->check(CLI::Range(0.0, 1e8))
      ->type_name("GAMMA");
}

void add_input_options(CLI::App& command, EventArguments& a) {
  command
      .add_option("FILE", a.files,
                  "Events: .toml (one), .csv (a catalogue), SRCMOD or USGS .fsp, USGS .json, - for stdin; none: the "
                  "shipped catalogue")
      ->type_name("");
  command
      .add_option("--columns", a.column_map,
                  "TOML file that maps the titles of CSV columns to quantities: [columns] \"VR\" = \"rupture_velocity "
                  "km/s\"; also decimal, separator, skip_lines, missing")
      ->type_name("MAP.toml");
  command.add_flag("--strict", a.strict,
                   "Refuse a file with a bad row, or with a column that looks like a quantity and is not understood");
}

}  // namespace

Runner add_event(CLI::App& app) {
  auto arguments = std::make_shared<EventArguments>();
  CLI::App* command =
      app.add_subcommand("event", "Stress, contact ratio and frictionless slip velocity of observed events");
  command->footer(
      "Examples:"
      "\n  slipfront event"
      "\n  slipfront event cases/parkfield-2004.toml cases/ets.toml"
      "\n  slipfront event cases/catalogue.csv --population");
  add_input_options(*command, *arguments);
  add_medium_options(command, arguments->medium);
  add_sampling_options(command, *arguments);
  add_source_options(command, *arguments);
  command->add_flag("--pulse", arguments->pulse,
                    "Run a frictionless pulse through the slip distribution of a .fsp, and compare its front and slip "
                    "with those of the model");
  command->add_flag(
      "--population", arguments->population,
      "Print statistics by decade of rupture velocity instead of events (with --json: in addition): number "
      "of events, medians and 5-95 % ranges of the known quantities, and the closed form");
  command
      ->add_option(
          "-o,--output", arguments->output,
          "File to write instead of the table: NetCDF; CSV rows if the name ends in .csv; the kinematic source of one "
          "finite-fault model (Standard Rupture Format 2.0) if it ends in .srf")
      ->check([](const std::string& path) { return path.empty() ? "the file name is empty" : ""; })
      ->type_name("OUT.nc");
  command->add_option("--resume", arguments->resume, "Resume from an unfinished file of these events, and write to it")
      ->type_name("OUT.nc");
  add_common_options(*command, arguments->common);
  return [arguments] { return run_event(*arguments); };
}
