#include "event_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "batch.hpp"
#include "event_print.hpp"
#include "interrupts.hpp"
#include "progress.hpp"
#include "runs/catalogue.hpp"
#include "runs/record/events/event_file.hpp"
#include "system/files/whole_file.hpp"

using slipfront::results::EventResult;
using slipfront::run::EventText;

namespace {

/// The texts of all files. A file that cannot be read has the reason instead.
std::vector<EventText> texts_of(const EventArguments& a) {
  if (a.files.empty()) return {{"catalogue.csv", std::string(shipped_catalogue)}};
  std::vector<EventText> all;
  for (const std::string& file : a.files) try {
      if (file == "-")
        all.push_back({"stdin", slipfront::record::read_standard_input()});
      else
        for (EventText& text : slipfront::run::texts_of(file)) all.push_back(std::move(text));
    } catch (const slipfront::FileError& error) {
      all.push_back({file, {}, error.what()});
    }
  return all;
}

/// With --samples all events are sampled. With --json the results also have quantities along the fault.
slipfront::run::CatalogueScenario scenario_of(const EventArguments& a) {
  std::string line = "slipfront event";
  for (const std::string& file : a.files) line += " " + file;
  slipfront::inference::Sampling sampling{
      .seed = a.seed, .closure = slipfront::friction::closure_named(a.closure), .draws = a.draws};
  if (a.samples) sampling.samples = *a.samples;
  slipfront::catalogue::TableOptions table;
  if (!a.column_map.empty()) table = {slipfront::record::read_text(a.column_map), a.column_map};
  slipfront::catalogue::check_column_map(table);
  return {.texts = texts_of(a),
          .table = table,
          .strict = a.strict,
          .medium = a.medium,
          .evaluation = {.sampling = sampling,
                         .sample_all = a.samples.has_value(),
                         .along_fault = a.common.json,
                         .pulse = a.pulse},
          .command_line = line};
}

/// Ends the output. It does not report the ignored columns of the shipped catalogue, because the user did not write
/// them.
int finish(EventPrinter& printer, const EventArguments& a, const slipfront::run::CatalogueColumns& columns,
           const std::string& path) {
  printer.finish(a.files.empty() ? slipfront::run::CatalogueColumns{} : columns, path);
  return columns.unreadable ? exit_file : printer.errors() > 0 ? exit_input : exit_done;
}

bool is_csv(const std::string& path) { return std::string_view(path).ends_with(".csv"); }

/// \throws InputError for an output file whose name is neither NetCDF nor CSV, or that is also an input file.
void check_names(const EventArguments& a) {
  const auto refuse = [](const char* option, const std::string& value, const char* allowed) {
    throw slipfront::InputError(
        {.file = "command line", .key = option, .value = value, .problem = "cannot be used here", .allowed = allowed});
  };
  const auto is_netcdf = [](const std::string& path) { return std::string_view(path).ends_with(".nc"); };
  if (!a.output.empty() && !is_netcdf(a.output) && !is_csv(a.output) && !describes_fault(a))
    refuse("-o", a.output, "OUT.nc, OUT.csv, OUT.srf or OUT.fsp");
  if (!a.resume.empty() && !is_netcdf(a.resume)) refuse("--resume", a.resume, "OUT.nc, as -o wrote it");
  const bool holds_events = is_netcdf(a.output) && !describes_fault(a);
  if (a.draws > 0 && !a.output.empty() && !holds_events) refuse("-o", a.output, "OUT.nc, with --draws");
  if (!a.resume.empty() && !a.output.empty() && !holds_events) refuse("-o", a.output, "OUT.nc, with --resume");
  if ((a.pulse || a.population) && describes_fault(a))
    refuse("-o", a.output, "OUT.nc or OUT.csv, with --pulse or --population");
}

constexpr const char* nothing_written = "; nothing was written (a run with -o OUT.nc can be resumed)";

/// Runs the catalogue with a progress line. Ctrl-C interrupts it.
slipfront::run::CatalogueResult run_watched(const EventArguments& a, slipfront::run::CataloguePlan&& plan,
                                            const slipfront::record::Output& output) {
  interrupted_means(
      output.wanted() ? "; the last checkpoint is saved: continue with " + output.how_to_resume() : nothing_written,
      output.wanted() ? output.unfinished() : "");
  const WatchInterrupts watch;
  std::optional<Progress> progress;
  const auto total = static_cast<double>(plan.entries.size());
  return slipfront::run::catalogue(
      std::move(plan),
      {.output = output, .resume = a.resume, .threads = a.common.threads, .after_step = [&](std::size_t done) {
         const auto now = static_cast<double>(done);
         if (!progress) {
           progress.emplace(total, !a.common.quiet, std::string(), ProgressWords{"", "events", 8});
           progress->from(now, static_cast<long>(done));
         }
         progress->at(now, static_cast<long>(done));
         return interrupted_by_user();
       }});
}

}  // namespace

int print_events(const EventArguments& a) {
  std::optional<EventPrinter> printer;  // starts to print after the arguments have been checked
  const auto columns =
      slipfront::run::stream_catalogue(scenario_of(a), a.common.threads, [&](std::vector<EventResult>&& results) {
        if (!printer)
          printer.emplace(a.common, EventShown{.rows = !a.population, .population = a.population, .pulse = a.pulse});
        auto printed = in_parallel<EventPrinter::Printed>(
            results.size(), a.common.threads,
            [&](std::size_t i) { return printer->printed(results[i], results.size()); }, 1);
        for (auto& p : printed) printer->take(std::move(p));
      });
  return finish(*printer, a, columns, {});
}

int write_events(const EventArguments& a) {
  check_names(a);
  if (describes_fault(a)) return write_fault(a, scenario_of(a));
  const std::string& path = a.output.empty() ? a.resume : a.output;
  if (is_csv(path)) interrupted_means(nothing_written, "");  // also while the catalogue is read
  slipfront::run::CataloguePlan plan = slipfront::run::plan_catalogue(scenario_of(a), a.common.threads, true);
  const slipfront::record::Output output(is_csv(path) ? "" : path, a.resume);
  if (is_csv(path)) slipfront::record::require_disk_space(path, plan.disk);  // for NetCDF, run::catalogue checks
  const slipfront::run::CatalogueColumns columns = plan.columns;
  const std::size_t total = plan.entries.size();
  const slipfront::run::CatalogueResult result = run_watched(a, std::move(plan), output);
  if (!result.finished) {
    complain(
        fmt::format("interrupted after {} of {} events; {}", result.events.size(), total,
                    is_csv(path) ? std::string(nothing_written).substr(2) : "continue with " + output.how_to_resume()));
    return exit_interrupted;
  }
  if (is_csv(path)) slipfront::record::write_events_csv(path, result.events, a.pulse);
  EventPrinter printer(a.common, {.rows = false, .population = a.population, .pulse = a.pulse});
  for (const EventResult& event : result.events) printer.take(printer.printed(event, result.events.size()));
  return finish(printer, a, columns, path);
}
