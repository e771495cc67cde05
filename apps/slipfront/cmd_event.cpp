#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <system_error>
#include <utility>

#include "batch.hpp"
#include "commands.hpp"
#include "event_keep.hpp"
#include "event_output.hpp"
#include "event_print.hpp"
#include "slipfront/event/read.hpp"
#include "slipfront/record/text_file.hpp"

namespace {

using namespace slipfront::event;

struct Arguments {
  CommonOptions common;
  std::vector<std::string> files;
  StatedMedium medium;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 1;
  std::string closure = "consistent";
  bool pulse = false, population = false;
  std::string output, resume;
};

/// All events are sampled if the user says how often; those of --json are looked at along the fault.
Plan plan_of(const Arguments& a) {
  return {{.samples = a.samples.value_or(Sampling{}.samples),
           .seed = a.seed,
           .closure = a.closure == "paper" ? slipfront::modulation::Closure::paper
                                           : slipfront::modulation::Closure::consistent},
          a.samples.has_value(),
          a.common.json,
          a.pulse};
}

/// Reads all files; what cannot be read is an entry with the reason. `with_text` is given each file's name and text.
struct Read {
  std::vector<std::string> ignored_columns;
  bool unreadable = false;
};
Read read_all(const Arguments& a, const Sink& sink,
              const std::function<void(std::string_view, std::string_view)>& with_text) {
  Read all;
  auto& ignored = all.ignored_columns;
  const auto read = [&](std::string_view text, const std::string& name) {
    with_text(name, text);
    for (std::string& title : read_events(text, name, sink))
      if (std::find(ignored.begin(), ignored.end(), title) == ignored.end()) ignored.push_back(std::move(title));
  };
  if (a.files.empty()) {
    read(shipped_catalogue, "catalogue.csv");
    ignored.clear();  // ours, and known to be ignored
  }
  for (const std::string& file : a.files) {
    try {
      const bool standard_input = file == "-";
      read(standard_input ? slipfront::record::read_standard_input() : slipfront::record::read_text(file),
           standard_input ? "stdin" : file);
    } catch (const slipfront::FileError& error) {
      all.unreadable = true;
      with_text(file, error.what());
      Entry entry;
      entry.observation.name = file;
      entry.observation.file = file;
      entry.error = slipfront::Complaint{.problem = error.what()};
      sink(std::move(entry));
    }
  }
  return all;
}

int exit_code(const Read& read, const EventPrinter& printer) {
  return read.unreadable ? exit_file : printer.errors() > 0 ? exit_input : exit_done;
}

/// Events that are printed only: some at a time, so that a catalogue of a million rows is never held whole.
int run_and_print(const Arguments& a) {
  const MediumDefaults defaults = defaults_of(a.medium);
  const Plan plan = plan_of(a);
  EventPrinter printer(a.common, {.rows = !a.population, .population = a.population, .pulse = a.pulse});
  std::vector<Entry> waiting;
  const auto flush = [&] {
    auto printed = in_parallel<EventPrinter::Printed>(
        waiting.size(), a.common.threads,
        [&](std::size_t i) { return printer.printed(evaluate(std::move(waiting[i]), defaults, plan)); }, 1);
    waiting.clear();
    for (auto& p : printed) printer.take(std::move(p));
  };
  const Read read = read_all(
      a,
      [&](Entry&& entry) {
        waiting.push_back(std::move(entry));
        if (waiting.size() == 4096) flush();
      },
      [](std::string_view, std::string_view) {});
  flush();
  printer.finish(read.ignored_columns, {});
  return exit_code(read, printer);
}

bool is_csv(const std::string& path) { return std::string_view(path).ends_with(".csv"); }

/// \throws InputError for a file that is neither NetCDF nor CSV by its name, or that the events are read from.
void check_names(const Arguments& a) {
  const auto refuse = [](const char* option, const std::string& value, const char* allowed) {
    throw slipfront::InputError({.file = "command line",
                                 .key = option,
                                 .value = value,
                                 .problem = "cannot be such a file",
                                 .allowed = allowed});
  };
  const auto is_netcdf = [](const std::string& path) { return std::string_view(path).ends_with(".nc"); };
  if (!a.output.empty() && !is_netcdf(a.output) && !is_csv(a.output)) refuse("-o", a.output, "OUT.nc or OUT.csv");
  std::error_code not_there;
  for (const std::string& file : a.files)
    if (std::filesystem::equivalent(file, a.output, not_there)) refuse("-o", a.output, "another file than those read");
  if (!a.resume.empty() && !is_netcdf(a.resume)) refuse("--resume", a.resume, "OUT.nc, as -o wrote it");
  if (!a.resume.empty() && is_csv(a.output)) refuse("-o", a.output, "OUT.nc, with --resume");
}

/// What makes the results what they are; threads do not.
std::vector<std::pair<std::string, std::string>> settings_of(const Arguments& a, const Plan& plan,
                                                             const std::string& inputs) {
  const auto stated = [](const std::string& text) { return text.empty() ? "default" : text; };
  return {{"seed", fmt::format("{}", plan.sampling.seed)},
          {"samples", fmt::format("{}", plan.sampling.samples)},
          {"sampled_events", plan.all ? "all" : "those that speak of friction or errors"},
          {"closure", a.closure},
          {"pulse", a.pulse ? "yes" : "no"},
          {"p_wave_speed", stated(a.medium.p_wave_speed)},
          {"poisson_ratio", stated(a.medium.poisson_ratio)},
          {"shear_modulus", stated(a.medium.shear_modulus)},
          {"input_checksum", inputs}};
}

std::string command_line_of(const Arguments& a) {
  std::string line = "slipfront event";
  for (const std::string& file : a.files) line += " " + file;
  return line;
}

void write_rows(const std::string& path, const std::vector<EventResult>& results, bool with_pulse) {
  std::string text = event_csv_head(with_pulse);
  for (const EventResult& r : results) text += event_csv_row(r, with_pulse);
  slipfront::record::write_text(path, text);
}

/// Events that are written to a file.
int run_and_keep(const Arguments& a) {
  check_names(a);
  const MediumDefaults defaults = defaults_of(a.medium);
  const Plan plan = plan_of(a);
  std::vector<Entry> entries;
  std::string inputs;
  const Read read = read_all(
      a, [&](Entry&& entry) { entries.push_back(std::move(entry)); },
      [&](std::string_view name, std::string_view text) {
        inputs = slipfront::record::checksum_of_inputs(inputs, name, text);
      });
  const std::size_t total = entries.size();
  const std::string& path = a.output.empty() ? a.resume : a.output;
  const KeptEvents kept =
      evaluate_and_keep(std::move(entries), defaults, plan,
                        {.output = is_csv(path) ? "" : path,
                         .resume = a.resume,
                         .metadata = {SLIPFRONT_VERSION, command_line_of(a), settings_of(a, plan, inputs), a.pulse},
                         .threads = a.common.threads,
                         .quiet = a.common.quiet});
  if (!kept.finished) {
    complain(
        fmt::format("interrupted after {} of {} events; {}", kept.results.size(), total,
                    is_csv(path) ? "nothing was written: -o OUT.nc could be resumed" : "go on with --resume " + path));
    return exit_interrupted;
  }
  if (is_csv(path)) write_rows(path, kept.results, a.pulse);
  EventPrinter printer(a.common, {.rows = false, .population = a.population, .pulse = a.pulse});
  for (const EventResult& result : kept.results) printer.take(printer.printed(result));
  printer.finish(read.ignored_columns, path);
  return exit_code(read, printer);
}

int run_event(const Arguments& a) { return a.output.empty() && a.resume.empty() ? run_and_print(a) : run_and_keep(a); }

}  // namespace

Runner add_event(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("event", "Stress, contact ratio and frictionless slip velocity of observed events");
  command->add_option(
      "FILE", arguments->files,
      "Events: .toml (one), .csv (a catalogue), SRCMOD or USGS .fsp, - for stdin; none: the shipped catalogue");
  command
      ->add_option("--p-wave-speed", arguments->medium.p_wave_speed,
                   "For events that give no elastic constants (default: 6 km/s)")
      ->type_name("SPEED");
  command->add_option("--poisson-ratio", arguments->medium.poisson_ratio, "Likewise (default: 0.3)")
      ->type_name("RATIO");
  command->add_option("--shear-modulus", arguments->medium.shear_modulus, "Likewise (default: 30 GPa)")
      ->type_name("MODULUS");
  command
      ->add_option("--samples", arguments->samples,
                   "Sample every event with this many states of the fault (default: 1000 for events that carry an "
                   "uncertainty, a contact ratio, a stress drop or a friction coefficient; 0: none)")
      ->check(CLI::Range(0, 10000000));
  command->add_option("--seed", arguments->seed, "Of the samples (default: 1)");
  command->add_option("--closure", arguments->closure, "Of the friction: consistent (default) or paper")
      ->check(CLI::IsMember({"consistent", "paper"}));
  command->add_flag("--pulse", arguments->pulse,
                    "Run a frictionless pulse through the slip distribution of a .fsp; its front and slip beside the "
                    "model's");
  command->add_flag("--population", arguments->population,
                    "Decades of rupture velocity instead of events (with --json: besides): how many events each has, "
                    "medians and 5-95 % of what is known of them, and the closed form");
  command
      ->add_option("-o,--output", arguments->output,
                   "File to write instead of the table: NetCDF, or CSV rows by its ending")
      ->type_name("OUT.nc");
  command->add_option("--resume", arguments->resume, "Go on from an unfinished file of these events, and write to it")
      ->type_name("OUT.nc");
  add_common_options(*command, arguments->common);
  return [arguments] { return run_event(*arguments); };
}
