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
  const std::string_view output = a.output;
  if (a.fault_grid && !output.ends_with(".nc") && !output.ends_with(".csv"))
    throw slipfront::InputError({.file = "command line",
                                 .key = "--fault-grid",
                                 .problem = "there is no file to write the subfaults to",
                                 .allowed = "with -o OUT.nc or OUT.csv"});
  if (!a.srf_version.empty() && !output.ends_with(".srf"))
    throw slipfront::InputError({.file = "command line",
                                 .key = "--srf-version",
                                 .value = a.srf_version,
                                 .problem = "no SRF file is written",
                                 .allowed = "with -o OUT.srf"});
  if (a.damping_number && !output.ends_with(".srf"))
    throw slipfront::InputError({.file = "command line",
                                 .key = "--damping-number",
                                 .value = std::to_string(*a.damping_number),
                                 .problem = "no source is written",
                                 .allowed = "with -o OUT.srf"});
  return to_file ? write_events(a) : print_events(a);
}

void add_medium_options(CommandLine& command, slipfront::medium::StatedDefaults& medium) {
  command.option("--p-wave-speed", "SPEED", medium.p_wave_speed,
                 "For events that give no elastic constants (default: 6 km/s)");
  command.option("--poisson-ratio", "RATIO", medium.poisson_ratio,
                 "For events that give no elastic constants (default: 0.3)");
  command.option("--shear-modulus", "MODULUS", medium.shear_modulus,
                 "For events that give no elastic constants (default: 30 GPa)");
}

void add_sampling_options(CommandLine& command, EventArguments& arguments) {
  command
      .option("--samples", "N", arguments.samples,
              "Sample every event with this many states of the fault (default: 1000 for events that carry an "
              "uncertainty, a contact ratio, a stress drop or a friction coefficient; 0: none). Their number is "
              "doubled until it suffices for intervals")
      .in_range(0, 10000000);
  command
      .option("--draws", "N", arguments.draws,
              "Write this many states of the posterior of each sampled event too (with -o OUT.nc)")
      .in_range(1, 100000);
  command.option("--seed", "N", arguments.seed, "Seed of the samples (default: 1)");
  command.option("--closure", "NAME", arguments.closure, "Closure of the friction: consistent (default) or paper")
      .one_of({"consistent", "paper"});
}

void add_source_options(CommandLine& command, EventArguments& arguments) {
  command.flag(
      "--fault-grid", arguments.fault_grid,
      "Write the subfaults of one finite-fault model instead of events: rupture time, slip, rise time and static "
      "stress drop on a grid to OUT.nc, or one subfault a row to OUT.csv");
  command.option("--srf-version", "VERSION", arguments.srf_version, "Version of OUT.srf: 2.0 (default) or 1.0")
      .one_of({"1.0", "2.0"});
  command
      .option("--damping-number", "GAMMA", arguments.damping_number,
              "Slip-rate functions of OUT.srf: damping number at the end of the rise time; 0: constant slip rate "
              "(default: 10)")
      .in_range(0.0, 1e8);
}

void add_input_options(CommandLine& command, EventArguments& a) {
  command.option("FILE", "", a.files,
                 "Events: .toml (one), .csv (a catalogue), USGS .json, a finite-fault model (.fsp, SRF, .param, .rupt, "
                 "FFM.geojson, CSV of subfaults), a folder with sources of one event, - for stdin; none: the shipped "
                 "catalogue");
  command.option("--columns", "MAP.toml", a.column_map,
                 "TOML file that maps the titles of CSV columns to quantities: [columns] \"VR\" = \"rupture_velocity "
                 "km/s\"; also decimal, separator, skip_lines, missing");
  command.flag("--strict", a.strict,
               "Refuse a file with a bad row, or with a column that looks like a quantity and is not understood");
}

}  // namespace

Runner add_event(CommandLine& program) {
  auto arguments = std::make_shared<EventArguments>();
  CommandLine command =
      program.command("event", "Stress, contact ratio and frictionless slip velocity of observed events",
                      {"slipfront event", "slipfront event cases/parkfield-2004.toml cases/ets.toml",
                       "slipfront event cases/catalogue.csv --population"});
  add_input_options(command, *arguments);
  add_medium_options(command, arguments->medium);
  add_sampling_options(command, *arguments);
  add_source_options(command, *arguments);
  command.flag("--pulse", arguments->pulse,
               "Run a frictionless pulse through the slip of a finite-fault model, and compare its front and slip "
               "with those of the model");
  command.flag("--population", arguments->population,
               "Print statistics by decade of rupture velocity instead of events (with --json: in addition): number "
               "of events, medians and 5-95 % ranges of the known quantities, and the closed form");
  command
      .option(
          "-o,--output", "OUT.nc", arguments->output,
          "File to write instead of the table: NetCDF; CSV rows if the name ends in .csv; the kinematic source of one "
          "finite-fault model if it ends in .srf (Standard Rupture Format) or .fsp")
      .checked_by([](const std::string& path) { return path.empty() ? "the file name is empty" : ""; });
  command.option("--resume", "OUT.nc", arguments->resume,
                 "Resume from an unfinished file of these events, and write to it");
  add_common_options(command, arguments->common);
  return [arguments] { return run_event(*arguments); };
}
